#include "tests/ui/ui_tests.h"

#include <QApplication>
#include <QtTest>
#include <filesystem>
#include <iostream>
#include <utility>
#include <vector>

namespace btr::ui::tests {

std::map<std::string, Maker>& uiTests() {
  static std::map<std::string, Maker> tests;
  return tests;
}

bool enterUiTest(const std::string& file, Maker maker) {
  return uiTests().emplace(std::filesystem::path(file).stem().string(), std::move(maker)).second;
}

}  // namespace btr::ui::tests

int main(int argc, char** argv) {
  const auto& tests = btr::ui::tests::uiTests();
  const auto test = argc > 1 ? tests.find(argv[1]) : tests.end();
  if (test == tests.end()) {
    std::cerr << "ui_tests NAME [arguments of QTest]; names:";
    for (const auto& [name, maker] : tests) std::cerr << ' ' << name;
    std::cerr << '\n';
    return 2;
  }
  // Settings belong to the program's name: tests that run at once must not share them.
  std::string name = "ui_" + test->first;
  std::vector<char*> arguments{name.data()};
  arguments.insert(arguments.end(), argv + 2, argv + argc + 1);  // with the null pointer at their end
  int count = argc - 1;
  QApplication application(count, arguments.data());
  application.setAttribute(Qt::AA_Use96Dpi, true);
  const std::unique_ptr<QObject> object = test->second();
  return QTest::qExec(object.get(), count, arguments.data());
}
