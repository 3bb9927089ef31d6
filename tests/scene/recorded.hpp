#pragma once
// A run of a scene text, with its samples by the names of their columns.

#include "bodies.hpp"

namespace liecheck::test {

struct Recorded {
  scene::Scene scene;
  scene::Run run;

  explicit Recorded(const scene::Scene& s) : scene(s), run(scene::run(scene)) {}
  explicit Recorded(const std::string& text)
      : Recorded(loadSceneText(text, "s.yaml", LIECHECK_FIXTURES "/scenes")) {}

  std::vector<double> operator[](const std::string& name) const {
    std::vector<double> all;
    for (std::size_t i = place(name); i < run.rows.size(); i += run.columns.size())
      all.push_back(run.rows[i]);
    return all;
  }
  std::string unit(const std::string& name) const { return run.columns[place(name)].unit; }
  std::string names() const {
    std::string all;
    for (const scene::Column& c : run.columns) all += (all.empty() ? "" : " ") + c.name;
    return all;
  }
  double figure(const std::string& name) const {
    for (const scene::Figure& f : run.figures)
      if (f.name == name) return f.value.value();
    throw std::logic_error("no figure is named '" + name + "'");
  }

 private:
  std::size_t place(const std::string& name) const {
    for (std::size_t k = 0; k < run.columns.size(); ++k)
      if (run.columns[k].name == name) return k;
    throw std::logic_error("no column is named '" + name + "'");
  }
};

}  // namespace liecheck::test
