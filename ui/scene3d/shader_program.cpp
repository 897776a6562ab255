#include "ui/scene3d/shader_program.h"

namespace btr::ui {

osg::ref_ptr<osg::Program> shaderProgram(const std::vector<std::string>& vertex,
                                         const std::vector<std::string>& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  for (const std::string& text : vertex) program->addShader(new osg::Shader(osg::Shader::VERTEX, text));
  for (const std::string& text : fragment) program->addShader(new osg::Shader(osg::Shader::FRAGMENT, text));
  return program;
}

std::string measuring(const std::string& shader) {
  const std::size_t second = shader.find('\n') + 1;  // nothing stands before the version
  return shader.substr(0, second) + "#define MEASURED\n" + shader.substr(second);
}

}  // namespace btr::ui
