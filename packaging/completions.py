#!/usr/bin/python3
"""completions.py PROGRAM FOLDER   writes completion for bash, zsh and fish, from what the program says of itself."""

import os
import sys

import command_line

BASH = """# Completion of hersey for bash: commands, their options, and files where a value is asked for.
_hersey() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} command= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do [[ $word == -* ]] || {{ command=$word; break; }}; done
  local options=
  case $command in
{cases}
    "") options="{commands} --help --version" ;;
  esac
  COMPREPLY=()
  if [[ -z $command || $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _hersey hersey
"""


def options_of(text):
    """(spelling, takes a value, meaning) of every option of a command."""
    for entry in text.sections.get("Options", []):
        for spelling in entry.spellings:
            yield spelling, bool(entry.value), entry.meaning


def bash(commands):
    cases = "\n".join(f'    {name}) options="{" ".join(s for s, _, _ in options_of(text))}" ;;' for name, text in commands.items())
    return BASH.format(cases=cases, commands=" ".join(commands))


def quoted(text):
    return text.replace("\\", "\\\\").replace("'", "'\\''").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")


def zsh(commands):
    lines = ["#compdef hersey", "_hersey() {", "  local -a commands", "  commands=("]
    lines += [f"    '{name}:{quoted(text.about.splitlines()[0])}'" for name, text in commands.items()]
    lines += ["  )", "  if (( CURRENT == 2 )); then _describe command commands; return; fi", "  case $words[2] in"]
    for name, text in commands.items():
        lines.append(f"    {name}) _arguments \\")
        for spelling, takes_value, meaning in options_of(text):
            lines.append(f"      '*{spelling}[{quoted(meaning)}]{':value:_files' if takes_value else ''}' \\")
        lines.append("      '*:file:_files' ;;")
    return "\n".join(lines + ["  esac", "}", '_hersey "$@"', ""])


def fish(commands):
    def plain(text):
        return text.replace("\\", "\\\\").replace("'", "\\'")

    lines = ["# Completion of hersey for fish."]
    for name, text in commands.items():
        about = plain(text.about.splitlines()[0])
        lines.append(f"complete -c hersey -n __fish_use_subcommand -f -a {name} -d '{about}'")
        for spelling, takes_value, meaning in options_of(text):
            kind = f"-l {spelling[2:]}" if spelling.startswith("--") else f"-s {spelling[1:]}"
            lines.append(f"complete -c hersey -n '__fish_seen_subcommand_from {name}' {kind}{' -r' if takes_value else ''} "
                         f"-d '{plain(meaning)}'")
    return "\n".join(lines) + "\n"


def main():
    program, folder = sys.argv[1:]
    _, commands = command_line.read_program(program)
    os.makedirs(folder, exist_ok=True)
    for name, text in (("hersey", bash(commands)), ("_hersey", zsh(commands)), ("hersey.fish", fish(commands))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
