"""Links from a page to a file or folder of the repository that is no page of the guide become its name: the guide stands alone."""

import re
from pathlib import Path

LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```|^    [^\n]*|`[^`\n]*`(?!\])", re.MULTILINE | re.DOTALL)
ROOT = Path(__file__).resolve().parents[2]


def plain(app, name, source):
    here = Path(app.env.doc2path(name)).parent

    def named(found):
        text, target = found.groups()
        path = target.split("#")[0]
        if not path or "://" in path:
            return found[0]
        whole = (here / path).resolve()
        if whole.is_relative_to(app.srcdir) and whole.suffix in (".md", ".png", ".svg", ".ipynb"):
            return found[0]
        shown = str(whole.relative_to(ROOT)) if whole.is_relative_to(ROOT) else text
        return f"`{shown}`" if text.strip("`") in shown else f"{text} (`{shown}`)"

    text, done, parts = source[0], 0, []
    for code in CODE.finditer(text):
        parts += [LINK.sub(named, text[done : code.start()]), code[0]]
        done = code.end()
    source[0] = "".join([*parts, LINK.sub(named, text[done:])])


def setup(app):
    app.connect("source-read", plain)
    return {"parallel_read_safe": True}
