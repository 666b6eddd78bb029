#!/usr/bin/python3
"""stage.py FOLDER   puts together what the site is built from: docs/ as it is, the model file on a page per section, the
examples as a gallery."""

import glob
import os
import re
import shutil
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
# The gallery's groups; an example that none of them names stands under the last.
GROUPS = {
    "Bearings by themselves": ["bearing_alone", "lemon_bore", "lobed_bores", "hot_bearing", "hot_pedestal", "plane_slider",
                               "hydrostatic", "oil_circuit", "squeeze_film_damper", "start_stop", "wear"],
    "Bearings in machines": ["paper_big_end", "slider_crank", "piston", "engine", "engine_oil", "flexible_big_end", "oil_whirl", "rotor_run_up",
                             "tilting_pads", "thrust_pads", "floating_ring", "turbocharger"],
    "Elastic bodies and rotors": ["conrod_pressure", "flexible_slider_crank", "flexible_rotor", "spinning_rod", "meshes"],
    "Mechanisms and contact": ["crank_train", "double_pendulum", "four_bar", "gyroscope", "squeezer", "ball_drop", "cam_follower"],
    "More": [],
}


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def write(text, *path):
    name = os.path.join(*path)
    os.makedirs(os.path.dirname(name), exist_ok=True)
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def anchor(heading):
    """The anchor that mkdocs gives a heading."""
    text = re.sub(r"[^\w\s-]", "", heading.replace("`", "")).strip().lower()
    return re.sub(r"[-\s]+", "-", text)


def split_model_file(folder):
    """docs/model-file.md on a page per section; links to its headings follow."""
    head, *sections = re.split(r"^## ", read(folder, "model-file.md"), flags=re.MULTILINE)
    where, names = {}, []
    for section in sections:
        title = section.splitlines()[0].strip()
        page = "model/" + anchor(title) + ".md"
        names.append((title, page))
        where |= {anchor(heading): page for heading in re.findall(r"^### (.+)$", section, re.MULTILINE)} | {anchor(title): page}

    def linked(text, prefix):
        return re.sub(r"\]\((?:model-file\.md)?#([\w-]+)\)",
                      lambda m: f"]({prefix}{where[m[1]]}#{m[1]})" if m[1] in where else m[0], text)

    for section, (title, page) in zip(sections, names):
        body = section.split("\n", 1)[1]
        body = re.sub(r"^### ", "## ", body, flags=re.MULTILINE)
        body = re.sub(r"\]\((?!https?:|#)(?=[^)]*\.(?:md|json))", "](../", body)
        write(f"# {title} {{#{anchor(title)}}}\n\n{linked(body, '../')}", folder, page)
    contents = "".join(f"- [{title}]({page})\n" for title, page in names)
    write(f"{linked(head, '')}## Sections\n\n{contents}", folder, "model-file.md")
    return [page for _, page in names]


def stage_examples(folder):
    """Each example's page with its pictures and models, and the gallery."""
    names = sorted(os.path.basename(os.path.dirname(path)) for path in glob.glob(os.path.join(ROOT, "examples/*/README.md")))
    for name in names:
        source = os.path.join(ROOT, "examples", name)
        for file in os.listdir(source):
            if file.endswith((".png", ".yaml", ".py", ".csv")):
                os.makedirs(os.path.join(folder, "examples", name), exist_ok=True)
                shutil.copy(os.path.join(source, file), os.path.join(folder, "examples", name))
        text = read(source, "README.md").replace("](../../docs/", "](../../")
        text = re.sub(r"\]\(\.\./(\w+)/README\.md", r"](../\1/index.md", text)
        text = re.sub(r"\[([^\]]*)\]\((?:\.\./)+(?!\.\.)(?![\w/.-]*(?:index\.md|\.png))(?:examples|verification|tests|validation|scripts)/[^)]*\)", r"\1", text)
        write(text, folder, "examples", name, "index.md")
    placed = {name for group in GROUPS.values() for name in group}
    out = "# Examples\n\nEach is a folder of `examples/` with its model; a picture leads to what there is to see.\n"
    for title, members in GROUPS.items():
        members = members if title != "More" else [name for name in names if name not in placed]
        if members:
            out += f"\n## {title}\n\n<div class=\"gallery\">\n" + "".join(card(folder, name) for name in members if name in names) + "</div>\n"
    write(out, folder, "examples.md")
    return names


def card(folder, name):
    """One picture with title and first sentence. Examples without a picture of their own have a drawn one."""
    text = read(folder, "examples", name, "index.md")
    title = re.search(r"^# (.+)$", text, re.MULTILINE).group(1)
    first = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", text.split("\n\n")[1].replace("\n", " "))
    sentence = re.match(r".*?[.:](?=\s|$)", first)
    pictures = sorted(glob.glob(os.path.join(folder, "examples", name, "*.png")), key=lambda path: ("machine" not in path, path))
    drawn = os.path.join("pictures", f"example_{name}.svg")
    picture = f"examples/{name}/{os.path.basename(pictures[0])}" if pictures else drawn if os.path.exists(os.path.join(folder, drawn)) else None
    image = f'<img src="{picture}" alt="" loading="lazy">' if picture else '<span class="plain" aria-hidden="true"></span>'
    return f'<a class="card" href="examples/{name}/index.html">{image}<strong>{title}</strong><span>{(sentence.group() if sentence else first).rstrip(":")}</span></a>\n'


def main():
    folder = os.path.abspath(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(os.path.join(ROOT, "docs"), folder)
    sections = split_model_file(folder)
    examples = stage_examples(folder)
    # mkdocs.yml's menu, with the pages that are made here in their places.
    menu = read(ROOT, "mkdocs.yml")
    for mark, pages in (("  # sections of the model file", [f"model/{os.path.basename(page)}" for page in sections]),
                        ("  # examples", [f"examples/{name}/index.md" for name in examples])):
        line = re.search(rf"^( *){mark.strip()}$", menu, re.MULTILINE)
        menu = menu.replace(line.group(), "\n".join(f"{line.group(1)}- {page}" for page in pages))
    menu = menu.replace("docs_dir: docs", f"docs_dir: {folder}").replace("- scripts/site/hooks.py", f"- {ROOT}/scripts/site/hooks.py")
    write(menu, os.path.dirname(folder), "mkdocs.yml")


if __name__ == "__main__":
    main()
