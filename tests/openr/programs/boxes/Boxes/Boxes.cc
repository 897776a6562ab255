#include "Boxes.h"
#include <string.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/ODebug.h>
#include <OPENR/OTime.h>
#include <OPENR/OCalendarTime.h>
#include <OPENR/core_macro.h>
Boxes::Boxes() : sent(0) {}
OStatus Boxes::DoInit(const OSystemEvent& event) {
    NEW_ALL_SUBJECT_AND_OBSERVER;
    REGISTER_ALL_ENTRY;
    SET_ALL_READY_AND_NOTIFY_ENTRY;
    return oSUCCESS;
}
OStatus Boxes::DoStart(const OSystemEvent& event) {
    Lists(); Times();
    ENABLE_ALL_SUBJECT;
    ASSERT_READY_TO_ALL_OBSERVER;
    return oSUCCESS;
}
OStatus Boxes::DoStop(const OSystemEvent& event) { DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Boxes::DoDestroy(const OSystemEvent& event) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
void Boxes::Lists() {
    Passwd p;
    strcpy(p.user, "root"); strcpy(p.pass, "*"); OSYSPRINT(("push %d", logins.PushBack(p) == otlSUCCESS));
    strcpy(p.user, "bob");  logins.PushFront(p);
    strcpy(p.user, "eve");  logins.Insert(logins.End(), p);
    OSYSPRINT((" full %d size %d of %d\n", logins.PushBack(p) == otlOVERFLOW, logins.GetSize(), logins.GetMaxSize()));
    OList<Passwd, MAX_LOGIN>::Iterator iter = logins.Begin();
    OList<Passwd, MAX_LOGIN>::Iterator last = logins.End();
    while (iter != last) { OSYSPRINT(("[%s]", (*iter).user)); ++iter; }
    --iter;
    PRINTF((" last %s\n", (*iter).user));
    logins.Erase(logins.Begin());
    OSYSPRINT(("front %s back %s\n", logins.Front().user, logins.Back().user));
    logins.PopFront(); logins.PopBack();
    OSYSPRINT(("empty %d underflow %d %d\n", logins.GetSize(), logins.PopBack() == otlUNDERFLOW, logins.Erase(logins.Begin()) != otlSUCCESS));
    for (int i = 0; i < 5; i++) if (queue.PushBack(i) != otlSUCCESS) OSYSPRINT(("queue full at %d\n", i));
    queue.PopFront(); queue.PushBack(9);
    while (queue.GetSize() > 0) { OSYSPRINT(("%d ", queue.Front())); queue.PopFront(); }
    ODeque<double, 3> d;
    d.PushFront(1.5); d.PushFront(0.5); d.PushBack(2.5);
    OSYSPRINT(("deque %.1f %.1f %d\n", d.Front(), d.Back(), d.GetSize()));
}
void Boxes::Times() {
    sbyte diff; OTime t;
    OPENR::SetTimeDifference(9); OPENR::GetTimeDifference(&diff);
    OPENR::GetTime(&t);
    char date[128];
    OCalendarTime c(t);
    c.RFC2822(date);
    OSYSPRINT(("%d %s\n", diff, date));
    OTime when(1136178245u - 946684800u, -3);   // 2006-01-02 05:04:05 UTC
    OCalendarTime w(when);
    w.RFC2822(date);
    OSYSPRINT(("%s year %d dow %d\n", date, w.year_ + otimeSTART_YEAR, w.dow_ == ocldtdowMONDAY));
    w.month_ = 2; w.day_ = 30;
    OSYSPRINT(("proper %d leap %d\n", w.ProperDate(), LeapYear(2004)));
    w.day_ = 28; w.CorrectDayOfTheWeek();
    time_t clock; sbyte dif;
    w.GetTime(&clock, &dif);
    OSYSPRINT(("dow %d dif %d later %d\n", w.dow_, dif, OCalendarTime(when) < w));
    OTime none;
    OSYSPRINT(("none %d\n", none.GetTimeDif() == otimeTIME_DIF_UNDEF));
    c.SetTime(0, 0); c.Print();
}
void Boxes::Ready(const OReadyEvent& event) {
    if (sent >= 2) return;
    if (shape.RCRPtr() == 0) shape.Allocate();
    Shape s; memset(&s, 0, sizeof(s)); s.id = ++sent; s.x = 0.5; strcpy(s.name, "cube");
    shape[0] = s;                       // copies when somebody still looks
    subject[event.SbjIndex()]->SetData(shape);
    subject[event.SbjIndex()]->NotifyObservers();
}
void Boxes::Notify(const ONotifyEvent& event) {
    OShmPtr<Shape> got(event.RCData(0));
    const OShmPtr<Shape>& r = got;
    OSYSPRINT(("shape %d %s x %f elements %d refs %d\n", r[0].id, got->name, got->x, got.NumOfElement(), event.RCData(0)->NumberOfReference() > 1));
    observer[event.ObsIndex()]->AssertReady(event.SenderID());
}
