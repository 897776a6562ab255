#pragma once
#include <QObject>
#include <QProcess>
#include <QString>

namespace btr::ui {

/// What the open interface is started with.
struct InterfaceOptions {
  int port = 50051;  ///< of this machine alone; 0: any that is free
  QString folder;    ///< whose files clients may name; "": the program's own, which are only read
  QString database;  ///< "": none
};

/// The open interface beside the window: btr-serve, a process of its own, off until it is asked for. Ends with this.
class InterfaceServer : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr-serve beside this executable.
  explicit InterfaceServer(const QString& program = {}, QObject* parent = nullptr);
  ~InterfaceServer() override;

  void start(const InterfaceOptions& options);
  /// Worlds end their logs, runs stop and go on later.
  void stop();
  bool isOn() const { return process_.state() != QProcess::NotRunning; }
  /// One line: where it listens, or why it does not.
  QString state() const { return state_; }

 signals:
  void changed();

 private:
  void read();
  void tell(const QString& state);

  QString program_, state_;
  QByteArray out_, errors_;
  QProcess process_;
};

}  // namespace btr::ui
