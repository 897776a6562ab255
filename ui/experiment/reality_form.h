#pragma once
#include <QWidget>
#include <vector>

#include "core/plugin/reality.h"
#include "core/spec/experiment_spec.h"

class QLineEdit;
class QUndoStack;

namespace btr::ui {
class ParameterForm;

/// What a reality plugin lets the user set: its paths and texts, and its numbers. One page for each plugin, of which
/// one is seen; what was typed on the others stays while the form lives.
class RealityForm : public QWidget {
  Q_OBJECT
 public:
  struct Offer {
    QString name, meaning;
    std::vector<Parameter> settings = {};
    std::vector<TextSetting> texts = {};
  };
  RealityForm(const std::vector<Offer>& offers, QUndoStack& undo, QWidget* parent = nullptr);

  /// Plugins that were loaded since; those that are there stay as they are.
  void addOffers(const std::vector<Offer>& offers);
  void show(const QString& name);  ///< its page, or none
  /// Not an undo step. Throws InputError if a setting is not allowed.
  void setOptions(const QString& name, const RealityOptions& options);
  RealityOptions options(const QString& name) const;
  QStringList problems(const QString& name) const;
  ParameterForm* numbers(const QString& name) const;  ///< of its page; nullptr if it has none
  void setReadOnly(bool readOnly);

 signals:
  void changed();

 private:
  struct Page {
    Offer offer;
    QWidget* widget;
    std::vector<QLineEdit*> texts;
    ParameterForm* numbers;
  };
  const Page* page(const QString& name) const;
  QLineEdit* addText(Page& page, const TextSetting& setting);

  QUndoStack& undo_;
  std::vector<Page> pages_;
};

}  // namespace btr::ui
