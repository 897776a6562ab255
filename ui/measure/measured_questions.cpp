#include "ui/measure/measured_questions.h"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>

#include "core/run/reality/measured_import.h"

namespace btr::ui {
namespace {

struct Questions {
  Q_DECLARE_TR_FUNCTIONS(MeasuredQuestions)
};

bool ask(QWidget* parent, const QString& text, const QString& details, const QString& yes, const char* name) {
  QMessageBox box(QMessageBox::Warning, Questions::tr("Measured fitness"), text, QMessageBox::Cancel, parent);
  box.setInformativeText(details);
  auto* accept = box.addButton(yes, QMessageBox::AcceptRole);
  accept->setObjectName(name);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == accept;
}

}  // namespace

ImportAnswer askAboutImport(QWidget* parent, const QString& file, const KnownFitness& known) {
  std::vector<std::string> places;
  const auto values = readMeasuredCsv(file.toStdString(), &known.tasks, known.unit, &places);
  QStringList lines;
  for (const Doubt& doubt : doubts(known, values))
    // What is impossible is refused by the import itself.
    if (!doubt.isImpossible) lines << QString::fromStdString(places[doubt.index] + ": " + doubt.sentence);
  if (lines.isEmpty()) return ImportAnswer::nothingAsked;
  constexpr qsizetype most = 12;
  if (lines.size() > most) lines = lines.mid(0, most) << Questions::tr("and %1 more").arg(lines.size() - most);
  return ask(parent, Questions::tr("Some values of this table are far from what is expected. Store them all the same?"),
             lines.join('\n'), Questions::tr("They are right, store them"), "importDoubtful")
             ? ImportAnswer::confirmed
             : ImportAnswer::cancelled;
}

bool askToGoBack(QWidget* parent, const RestingSimulator& resting) {
  return ask(parent,
             Questions::tr("Simulator version %1 was adapted to this value in stage %2 and stays as it is.")
                 .arg(resting.number)
                 .arg(resting.stage),
             Questions::tr("Go back to version %1? The next adaptation then begins there, with the values that count. "
                           "Nothing is deleted; every version can be taken again.")
                 .arg(resting.parent),
             Questions::tr("Go back to version %1").arg(resting.parent), "goBack");
}

}  // namespace btr::ui
