#pragma once
#include <osg/Program>

#include <string>
#include <vector>

namespace btr::ui {

/// Of GLSL texts, see shaders.h.
osg::ref_ptr<osg::Program> shaderProgram(const std::vector<std::string>& vertex,
                                         const std::vector<std::string>& fragment);

/// A fragment shader as a measurement has it: MEASURED is defined in it.
std::string measuring(const std::string& shader);

}  // namespace btr::ui
