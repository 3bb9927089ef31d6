#include <app/completion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <budgets/profile.hpp>
#include <campaign/selection.hpp>
#include <operations/list.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

using CompletedCommands = std::vector<CompletedCommand>;

/// The names that this build offers as the value of a flag.
struct Values {
  std::string flag, words;
};
std::vector<Values> values() {
  std::vector<std::string> subjects{"all"}, operations;
  for (const std::string& name : subject_names())
    if (name.find(':') == std::string::npos) subjects.push_back(name);
  for (const Operation* o : all_operations()) operations.emplace_back(o->name);
  return {{"subject", fmt::format("{}", fmt::join(subjects, " "))},
          {"property", fmt::format("{}", fmt::join(property_names(), " "))},
          {"scalar", "float double"},
          {"op", fmt::format("{}", fmt::join(operations, " "))},
          {"operation", fmt::format("{}", fmt::join(operations, " "))},
          {"profile", fmt::format("{}", fmt::join(profile_names(), " "))},
          {"root", "free-flyer fixed"}};
}

std::string path_of(const CompletedCommand& c) {
  return c.group.empty() ? c.name : c.group + " " + c.name;
}

/// The commands of a group, or those at the top for "".
CompletedCommands in_group(const CompletedCommands& all, const std::string& group) {
  CompletedCommands found;
  for (const CompletedCommand& c : all)
    if (c.group == group) found.push_back(c);
  return found;
}

std::string names_of(const CompletedCommands& commands, const char* separator) {
  std::vector<std::string> names;
  for (const CompletedCommand& c : commands) names.push_back(c.name);
  return fmt::format("{}", fmt::join(names, separator));
}

std::vector<std::string> groups_of(const CompletedCommands& all) {
  std::vector<std::string> groups{""};
  for (const CompletedCommand& c : all)
    if (c.is_group) groups.push_back(c.name);
  return groups;
}

std::string in_bash(const std::string& program, const CompletedCommands& all) {
  std::string values_text, commands_text;
  for (const Values& v : values())
    values_text +=
        fmt::format("    --{}) COMPREPLY=($(compgen -W \"{}\" -- \"$now\")); return ;;\n", v.flag, v.words);
  for (const std::string& group : groups_of(all))
    commands_text += fmt::format("    \"{}\") words=\"{}\" ;;\n", group, names_of(in_group(all, group), " "));
  for (const CompletedCommand& c : all) {
    std::vector<std::string> names;
    for (const CompletedFlag& f : c.flags) names.insert(names.end(), f.names.begin(), f.names.end());
    if (!c.is_group)
      commands_text +=
          fmt::format("    \"{}\") [[ $now == -* ]] && words=\"{}\" ;;\n", path_of(c), fmt::join(names, " "));
  }
  return fmt::format(R"~(# In ~/.bashrc: eval "$({0} completion bash)"
_{0}() {{
  local now="${{COMP_WORDS[COMP_CWORD]}}" command="" words="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command" in
    ""{1}) [[ ${{COMP_WORDS[i]}} == -* ]] || command="${{command:+$command }}${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "${{COMP_WORDS[COMP_CWORD - 1]}}" in
{2}  esac
  case "$command" in
{3}  esac
  COMPREPLY=($(compgen -W "$words" -- "$now"))
}}
complete -o default -F _{0} {0}
)~",
                     program, fmt::join(groups_of(all), "|"), values_text, commands_text);
}

std::string in_zsh(const std::string& program, const CompletedCommands& all) {
  std::string values_text, commands_text;
  const auto described = [](const std::string& name, const std::string& help) {
    return shell_quoted(name + ":" + brief(help));
  };
  for (const Values& v : values())
    values_text += fmt::format("    (--{}) compadd -- {}; return ;;\n", v.flag, v.words);
  for (const std::string& group : groups_of(all)) {
    commands_text += fmt::format("    (\"{}\") all=(\n", group);
    for (const CompletedCommand& c : in_group(all, group))
      commands_text += fmt::format("      {}\n", described(c.name, c.help));
    commands_text += "    ); _describe command all; return ;;\n";
  }
  for (const CompletedCommand& c : all) {
    if (c.is_group) continue;
    commands_text += fmt::format("    (\"{}\") all=(\n", path_of(c));
    for (const CompletedFlag& f : c.flags)
      for (const std::string& name : f.names)
        commands_text += fmt::format("      {}\n", described(name, f.help));
    commands_text += "    ) ;;\n";
  }
  return fmt::format(R"~(#compdef {0}
# In ~/.zshrc, after compinit: eval "$({0} completion zsh)"
_{0}() {{
  local command="" i
  local -a all
  for ((i = 2; i < CURRENT; ++i)); do
    case "$command" in
    (""{1}) [[ $words[i] == -* ]] || command="${{command:+$command }}$words[i]" ;;
    esac
  done
  case "$words[CURRENT - 1]" in
{2}  esac
  case "$command" in
{3}  esac
  if [[ $words[CURRENT] == -* ]]; then _describe -o flag all; else _files; fi
}}
compdef _{0} {0}
)~",
                     program, fmt::join(groups_of(all), "|"), values_text, commands_text);
}

std::string in_fish(const std::string& program, const CompletedCommands& all) {
  std::string text = fmt::format("# As ~/.config/fish/completions/{}.fish\n", program);
  const auto known = values();
  const auto condition = [&](const std::string& group) {
    return group.empty()
               ? std::string("__fish_use_subcommand")
               : fmt::format("__fish_seen_subcommand_from {}; and not __fish_seen_subcommand_from {}", group,
                             names_of(in_group(all, group), " "));
  };
  for (const CompletedCommand& c : all) {
    text += fmt::format("complete -c {} -f -n '{}' -a {} -d {}\n", program, condition(c.group), c.name,
                        shell_quoted(brief(c.help)));
    const std::string given =
        fmt::format("{}__fish_seen_subcommand_from {}",
                    c.group.empty() ? "" : "__fish_seen_subcommand_from " + c.group + "; and ", c.name);
    for (const CompletedFlag& f : c.flags) {
      std::string names, words;
      for (const std::string& name : f.names) {
        const bool is_long = name.rfind("--", 0) == 0;
        names += is_long ? " -l " + name.substr(2) : " -s " + name.substr(1);
        for (const Values& v : known)
          if (name == "--" + v.flag) words = fmt::format(" -x -a '{}'", v.words);
      }
      text += fmt::format("complete -c {} -n '{}'{}{} -d {}\n", program, given, names,
                          !words.empty() ? words
                          : f.has_value  ? " -r"
                                         : "",
                          shell_quoted(brief(f.help)));
    }
  }
  return text;
}

}  // namespace

std::string brief(const std::string& help) {
  return help.substr(0, std::min({help.find(". "), help.find("; "), help.find(": ")}));
}

std::string completion_script(const std::string& program, const std::string& shell,
                              const CompletedCommands& commands) {
  return shell == "bash"  ? in_bash(program, commands)
         : shell == "zsh" ? in_zsh(program, commands)
                          : in_fish(program, commands);
}

}  // namespace liecheck::properties
