#pragma once
#include <QUndoCommand>
#include <QVariant>
#include <functional>

namespace btr::ui {

/// An undoable change of one field from one value to another. Changes of the same field within one visit (`key`,
/// `visit`) become one step; a negative visit never merges. Whoever owns the field owns the undo stack too, so `apply`
/// never outlives it.
class EditCommand final : public QUndoCommand {
 public:
  using Apply = std::function<void(const QVariant&)>;
  EditCommand(const QString& text, QString key, int visit, QVariant before, QVariant after, Apply apply)
      : QUndoCommand(text),
        key_(std::move(key)),
        visit_(visit),
        before_(std::move(before)),
        after_(std::move(after)),
        apply_(std::move(apply)) {}

  void undo() override { apply_(before_); }
  void redo() override { apply_(after_); }
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* later = dynamic_cast<const EditCommand*>(other);
    if (!later || visit_ < 0 || later->key_ != key_ || later->visit_ != visit_) return false;
    after_ = later->after_;
    setObsolete(after_ == before_);
    return true;
  }

 private:
  QString key_;
  int visit_;
  QVariant before_, after_;
  Apply apply_;
};

}  // namespace btr::ui
