#!/usr/bin/env bash
# The manual: every chapter is built, every link leads somewhere, every command and window name in it exists.
. "$(dirname "$0")/common.sh"

manual=$(cd "$(dirname "$btr")/.." && pwd)/share/uchilsim/manual
[ -d "$manual" ] || { fail "no manual was built: $manual"; finish; }
python3 - "$btr" "$root" "$manual" <<'P' || failures=1
import html.parser, os, re, subprocess, sys
btr, root, manual = sys.argv[1:]
source = os.path.join(root, "resources/manual")
problems = []


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.title = set(), [], ""
        self.feed(open(path, encoding="utf-8").read())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            if (tag, name) in (("a", "href"), ("img", "src"), ("link", "href")):
                self.links.append(value)


# Every chapter of the sources is a page, and every page comes from one.
def files(folder, ending):
    return {os.path.relpath(os.path.join(at, name), folder)[:-len(ending)]
            for at, _, names in os.walk(folder) for name in names if name.endswith(ending)}


chapters = files(source, ".md")
built = files(manual, ".html")
for chapter in chapters | {"results"}:
    if chapter not in built:
        problems.append(f"{chapter}.md was not built")
pages = {name: Page(os.path.join(manual, name + ".html")) for name in chapters & built | {"results"} & built}

# Links between the pages, into the middle of one, and to pictures.
for name, page in pages.items():
    for link in page.links:
        if re.match(r"[a-z]+:", link):
            continue
        target, _, anchor = link.partition("#")
        path = os.path.normpath(os.path.join(manual, os.path.dirname(name), target)) if target else os.path.join(manual, name + ".html")
        if not os.path.isfile(path):
            problems.append(f"{name}: {link} leads nowhere")
        elif anchor:
            other = pages.get(os.path.relpath(path, manual)[:-5])
            if other is None or anchor not in other.ids:
                problems.append(f"{name}: {link} has no such place")

# Links of the sources as they are read without the build.
documents = [os.path.join(root, name) for name in ("README.md", "CHANGELOG.md", "resources/results.md")]
documents += [os.path.join(source, chapter + ".md") for chapter in chapters]
for path in documents:
    text = open(path, encoding="utf-8").read()
    for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", re.sub(r"```.*?```", "", text, flags=re.S)):
        if not re.match(r"[a-z]+:", link) and not os.path.exists(os.path.join(os.path.dirname(path), link)):
            problems.append(f"{os.path.relpath(path, root)}: {link} leads nowhere")

# Every command has the options that it is shown with, and the project's files that it names are there.
helps = {}


def help_of(words):
    if words not in helps:
        result = subprocess.run([btr, *words, "--help"], capture_output=True, text=True)
        helps[words] = result.stdout if result.returncode == 0 else None
    return helps[words]


commands = {command: help_of((command,)) for command in re.findall(r"^  ([a-z][a-z0-9-]*) ", help_of(()).split("Subcommands:")[1], re.M)}
for path in documents:
    where = os.path.relpath(path, root)
    text = open(path, encoding="utf-8").read().replace("\\\n", " ")
    blocks = "\n".join(re.findall(r"```\n(.*?)```", text, re.S))
    inline = "\n".join(re.findall(r"(?<!`)`([^`]+)`(?!`)", re.sub(r"```.*?```", "", text, flags=re.S)))
    for line in re.findall(r"(?:^|; do )(?:[A-Z_]+=\S+ )?(?:build/release/bin/)?btr (.*)", blocks + "\n" + inline, re.M):
        words = []
        tokens = [token for token in line.split() if token != "--json"]
        for token in tokens:
            if not re.fullmatch(r"[a-z][a-z0-9-]*", token) or help_of(tuple(words + [token])) is None:
                break
            if f"\n  {token} " not in help_of(tuple(words)):
                break
            words.append(token)
        alternatives = re.match(r"(gap|fitness) ([a-z]+(?:\|[a-z]+)+)", line)
        if not words:
            if not line.startswith(("…", "--", "COMMAND")):
                problems.append(f"{where}: no command: btr {line}")
            continue
        if alternatives:
            for word in alternatives.group(2).split("|"):
                if help_of((alternatives.group(1), word)) is None:
                    problems.append(f"{where}: no command: btr {alternatives.group(1)} {word}")
            continue
        known = "".join(help_of(tuple(words[:count])) for count in range(len(words) + 1)) + " --help"
        for option in re.findall(r"(?<!\S)\[?(--[a-z][a-z0-9-]*)", line):
            if not re.search(re.escape(option) + r"(?![a-z-])", known):
                problems.append(f"{where}: btr {' '.join(words)} has no {option}")
        for name in re.findall(r"(?<!\S)((?:resources|tests)/[\w./-]+)(?![\w./{-])", line):
            if not os.path.exists(os.path.join(root, name)):
                problems.append(f"{where}: {name} is not there")

# Every name of a part of the window (in italics) stands in the window's sources.
window = ""
for at, _, names in os.walk(os.path.join(root, "ui")):
    for name in names:
        if name.endswith(".cpp"):
            window += open(os.path.join(at, name), encoding="utf-8").read()
window = re.sub(r"\"\s*\n\s*\"", "", window).replace("&", "")
for chapter in ("first-run", "experiments", "measuring", "charts", "gap-analysis", "index"):
    text = open(os.path.join(source, chapter + ".md"), encoding="utf-8").read()
    for name in re.findall(r"(?<![*\w])\*([^*\n]+)\*(?![*\w])", re.sub(r"```.*?```", "", text, flags=re.S)):
        for part in name.split(" → "):
            if part not in window:
                problems.append(f"{chapter}.md: the window has no “{part}”")

for problem in problems:
    print("FAILED:", problem)
sys.exit(1 if problems else 0)
P
words=$(wc -w < "$root/README.md")
[ "$words" -le 900 ] || fail "README.md has $words words, at most 900 are read"
finish
