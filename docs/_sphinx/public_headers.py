"""The page reference/cpp_api gets a section for each header that slapstick/slapstick.hpp includes: a new one cannot be forgotten.

What a header declares is read from Doxygen's XML; Breathe shows each declaration with its text.
"""

import itertools
import os
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
XML = Path(os.environ["SLAPSTICK_DOCS_XML"])
DIRECTIVES = {"enum": "doxygenenum", "typedef": "doxygentypedef", "variable": "doxygenvariable"}


def headers():
    text = (ROOT / "include/slapstick/slapstick.hpp").read_text()
    return re.findall(r'^#include "(slapstick/[^"]+)"', text, re.MULTILINE)


def place(element):
    return element.find("location").get("file")


def described(element):
    """Whether a declaration has a text: what has none is explained where it is used."""
    return any("".join(element.find(part).itertext()).strip() for part in ("briefdescription", "detaileddescription"))


def classes():
    """(header, directive) of every class that is in no other, in the order of their names in the XML."""
    for path in sorted(XML.glob("*.xml")):
        compound = ElementTree.parse(path).getroot().find("compounddef")
        if compound is None or compound.get("kind") not in ("class", "struct"):
            continue
        name = compound.findtext("compoundname")
        outer = name.rpartition("::")[0]
        nested = outer.rpartition("::")[2][:1].isupper()
        if not nested and "<" not in name:
            yield place(compound), int(compound.find("location").get("line")), f"doxygen{compound.get('kind')}", name, ":members:"


def members():
    """(header, line, directive, name, options) of functions, enumerations, names of types and constants of the namespaces."""
    for path in sorted(XML.glob("namespace*.xml")):
        compound = ElementTree.parse(path).getroot().find("compounddef")
        for member in compound.iter("memberdef"):
            if not described(member):
                continue
            kind, name = member.get("kind"), f"{compound.findtext('compoundname')}::{member.findtext('name')}"
            line = int(member.find("location").get("line"))
            if kind == "function":
                types = ", ".join("".join(p.find("type").itertext()) for p in member.findall("param"))
                yield place(member), line, "doxygenfunction", f"{name}({types})", ""
            elif kind in DIRECTIVES:
                yield place(member), line, DIRECTIVES[kind], name, ""


def about(header):
    """What the header says of itself. Breathe knows files by their last names: of two that share one, the comment is taken as it stands."""
    name = header.rsplit("/", 1)[1]
    if [other.rsplit("/", 1)[1] for other in headers()].count(name) == 1:
        return f"```{{doxygenfile}} {name}\n:sections: briefdescription detaileddescription\n```\n"
    lines = (ROOT / "include" / header).read_text(encoding="utf-8").split("\n")[1:]
    comment = itertools.takewhile(lambda line: line.startswith("///"), lines)
    return "\n".join(line[4:] for line in comment) + "\n"


def page():
    found = sorted({*classes(), *members()}, key=lambda entry: entry[:2])
    for header in headers():
        yield f"\n## {header}\n\n{about(header)}"
        for where, _, directive, name, options in found:
            if where == f"include/{header}":
                yield f"\n```{{{directive}}} {name}\n{options}\n```\n"


def add(app, name, source):
    if name == "reference/cpp_api":
        source[0] += "".join(page())


def setup(app):
    app.connect("source-read", add)
    return {"parallel_read_safe": True}
