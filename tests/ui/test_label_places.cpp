#include <QTest>
#include <random>

#include "tests/ui/ui_tests.h"
#include "ui/live/drawn/label_places.h"

using namespace btr::ui;

namespace {

const QRectF picture(10, 20, 416, 320);
const QSizeF label(80, 14);

}  // namespace

class TestLabelPlaces : public QObject {
  Q_OBJECT

 private slots:
  void aLabelStandsAboveItsBox();
  void atTheUpperRimItStandsBelow();
  void aBoxAsLargeAsThePictureHasItInside();
  void labelsOfTheSameBoxStandApart();
  void noneOverlapsHoweverMuchIsSeen();
};

void TestLabelPlaces::aLabelStandsAboveItsBox() {
  const QRectF box(100, 100, 50, 40);
  QCOMPARE(labelPlaces({{box, label}}, picture), std::vector{QRectF(QPointF(100, 100 - label.height()), label)});
  // At the right rim it is moved to the left.
  const QRectF place = labelPlaces({{QRectF(400, 100, 20, 20), label}}, picture).front();
  QCOMPARE(place.right(), picture.right());
}

void TestLabelPlaces::atTheUpperRimItStandsBelow() {
  const QRectF box(100, 20, 50, 40);
  QCOMPARE(labelPlaces({{box, label}}, picture).front().topLeft(), box.bottomLeft());
}

void TestLabelPlaces::aBoxAsLargeAsThePictureHasItInside() {
  QCOMPARE(labelPlaces({{picture, label}}, picture).front().topLeft(), picture.topLeft());
}

void TestLabelPlaces::labelsOfTheSameBoxStandApart() {
  const std::vector<LabelledBox> boxes(6, {QRectF(100, 100, 50, 40), label});
  const std::vector<QRectF> places = labelPlaces(boxes, picture);
  for (std::size_t i = 0; i < places.size(); ++i) {
    QVERIFY(picture.contains(places[i]));
    for (std::size_t k = 0; k < i; ++k) QVERIFY(!places[i].intersects(places[k]));
  }
}

void TestLabelPlaces::noneOverlapsHoweverMuchIsSeen() {
  std::mt19937 random(1);
  for (const int count : {10, 40, 300}) {
    std::vector<LabelledBox> boxes;
    for (int i = 0; i < count; ++i)
      boxes.push_back({QRectF(random() % 400, random() % 300, 1 + random() % 60, 1 + random() % 60),
                       QSizeF(20 + random() % 100, 14)});
    const std::vector<QRectF> places = labelPlaces(boxes, picture);
    QCOMPARE(places.size(), boxes.size());
    int shown = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].isNull()) continue;
      ++shown;
      QVERIFY(picture.contains(places[i]));
      QCOMPARE(places[i].size(), boxes[i].label);
      for (std::size_t k = 0; k < i; ++k) QVERIFY(!places[i].intersects(places[k]));
    }
    QVERIFY(shown >= 10);
    if (count == 10) QCOMPARE(shown, count);
  }
}

UI_TEST(TestLabelPlaces)
#include "test_label_places.moc"
