// Run, Open interface: off until it is switched on, says where it listens, and ends with its owner.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QCheckBox>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <memory>

#include "tests/ui/ui_tests.h"
#include "ui/remote/interface_dialog.h"
#include "ui/remote/interface_server.h"

namespace btr::ui {

/// A socket on a port of this machine: it listens there, or reached who does.
class Port {
 public:
  enum class Do { listen, reach };
  Port(Do what, int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(port));
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* at = reinterpret_cast<sockaddr*>(&address_);
    socklen_t size = sizeof address_;
    worked_ = what == Do::reach ? ::connect(socket_, at, size) == 0
                                : ::bind(socket_, at, size) == 0 && ::listen(socket_, 1) == 0;
    ::getsockname(socket_, at, &size);
  }
  ~Port() { ::close(socket_); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  bool worked() const { return worked_; }
  int number() const { return ntohs(address_.sin_port); }

 private:
  int socket_;
  sockaddr_in address_{};
  bool worked_ = false;
};

class TestInterfaceDialog : public QObject {
  Q_OBJECT
 private slots:
  void isOffUntilItIsSwitchedOnAndSaysWhereItListens();
  void saysWhyItDoesNotListen();
  void endsWithItsOwner();
  void everyLabelWithAKeyHasAFieldForIt();

 private:
  static QString serve() { return QFileInfo(BTR_PROGRAM).absolutePath() + "/btr-serve"; }
  static bool listens(int port) { return Port(Port::Do::reach, port).worked(); }
  /// "listens on 127.0.0.1:4711; …"
  static int portIn(const QString& state) { return state.section("127.0.0.1:", 1).section(';', 0, 0).toInt(); }
};

void TestInterfaceDialog::isOffUntilItIsSwitchedOnAndSaysWhereItListens() {
  InterfaceServer server(serve());
  InterfaceDialog dialog(server, [] { return QString(); });
  auto* state = dialog.findChild<QLabel*>("interface.state");
  auto* turn = dialog.findChild<QPushButton*>("interface.turn");
  QVERIFY(!server.isOn());
  QCOMPARE(state->text(), QString("Off."));
  dialog.findChild<QSpinBox*>("interface.port")->setValue(0);
  turn->click();
  QTRY_VERIFY_WITH_TIMEOUT(state->text().startsWith("listens on 127.0.0.1:"), 20000);
  QVERIFY(!dialog.findChild<QSpinBox*>("interface.port")->isEnabled());
  QVERIFY(listens(portIn(state->text())));
  const int port = portIn(state->text());
  turn->click();
  QTRY_COMPARE_WITH_TIMEOUT(state->text(), QString("Off."), 20000);
  QVERIFY(!listens(port));
  QVERIFY(dialog.findChild<QSpinBox*>("interface.port")->isEnabled());
}

void TestInterfaceDialog::saysWhyItDoesNotListen() {
  const Port taken(Port::Do::listen, 0);
  QVERIFY(taken.worked());
  InterfaceServer server(serve());
  InterfaceDialog dialog(server, [] { return QString(); });
  dialog.findChild<QSpinBox*>("interface.port")->setValue(taken.number());
  dialog.findChild<QPushButton*>("interface.turn")->click();
  const auto* state = dialog.findChild<QLabel*>("interface.state");
  QTRY_VERIFY_WITH_TIMEOUT(state->text().contains("free"), 20000);
  QVERIFY(!server.isOn());
  InterfaceServer absent("/nowhere/btr-serve");
  absent.start({});
  QTRY_VERIFY(absent.state().contains("cannot be started"));
}

// Elsewhere its "&" is shown as it is.
void TestInterfaceDialog::everyLabelWithAKeyHasAFieldForIt() {
  InterfaceServer server(serve());
  InterfaceDialog dialog(server, [] { return QString(); });
  for (const QLabel* label : dialog.findChildren<QLabel*>())
    QVERIFY2(!label->text().contains('&') || label->buddy(), qPrintable(label->text()));
}

void TestInterfaceDialog::endsWithItsOwner() {
  int port = 0;
  {
    InterfaceServer server(serve());
    server.start({0, {}, {}});
    QTRY_VERIFY_WITH_TIMEOUT(server.state().startsWith("listens on"), 20000);
    port = portIn(server.state());
    QVERIFY(listens(port));
  }
  QVERIFY(!listens(port));
}

}  // namespace btr::ui

UI_TEST(btr::ui::TestInterfaceDialog)
#include "test_interface_dialog.moc"
