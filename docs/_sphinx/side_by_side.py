"""The same task in the shell and in Python, side by side.

Neighbouring blocks of a page, ```console, ```python and ```cpp in any order, become tabs with one page-wide choice.
A block without a language below one of them is what it prints, and goes into its tab. The page stays plain Markdown.
"""

from docutils import nodes
from sphinx.transforms import SphinxTransform
from sphinx_design.shared import create_component

LABELS = {"console": "Shell", "python": "Python", "cpp": "C++"}


def language(node):
    return node.get("language", "") if isinstance(node, nodes.literal_block) else None


def groups(children):
    """Runs of neighbouring blocks, each as a list of tabs: a language and its nodes."""
    tabs, found = [], []
    for node in [*children, None]:
        kind = language(node) if node is not None else None
        if kind in LABELS:
            tabs.append((kind, [node]))
        elif kind in ("text", "default", "none") and tabs:
            tabs[-1][1].append(node)
        else:
            if len({name for name, _ in tabs}) > 1:
                found.append(tabs)
            tabs = []
    return found


def merged(tabs):
    """One tab for each language, in the order in which the languages come."""
    all_of = {}
    for kind, blocks in tabs:
        all_of.setdefault(kind, []).extend(blocks)
    return all_of.items()


class SideBySide(SphinxTransform):
    default_priority = 200

    def apply(self, **_):
        for section in list(self.document.findall(lambda node: isinstance(node, (nodes.section, nodes.document)))):
            for tabs in groups(section.children):
                self.replace(section, tabs)

    def replace(self, section, tabs):
        tab_set = create_component("tab-set", classes=["sd-tab-set"], selected=False)
        at = section.index(tabs[0][1][0])
        for _, blocks in tabs:
            for block in blocks:
                section.remove(block)
        for kind, blocks in merged(tabs):
            label = nodes.rubric(LABELS[kind], "", nodes.Text(LABELS[kind]), classes=["sd-tab-label"])
            label["sync_id"], label["sync_group"] = kind, "language"
            content = create_component("tab-content", classes=["sd-tab-content"], children=blocks)
            tab_set += create_component("tab-item", classes=["sd-tab-item"], children=[label, content], selected=False)
        section.insert(at, tab_set)


def setup(app):
    app.add_transform(SideBySide)
    return {"parallel_read_safe": True}
