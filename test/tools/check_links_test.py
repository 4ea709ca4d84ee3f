"""tools/check_links must find a link that leads nowhere, and only such."""
import sys

import trees

CASES = [
    ('a page and a heading', {'README.md': '[a](docs/a.md#two-words)\n', 'docs/a.md': '# One\n\n## Two words\n'}, None),
    ('a page that is gone', {'README.md': 'Text.\n[a](docs/b.md)\n'}, 'README.md:2: there is no docs/b.md'),
    ('a heading that is gone', {'README.md': '[a](docs/a.md#three)\n', 'docs/a.md': '# One\n'}, 'README.md:1: docs/a.md has no heading #three'),
    ('a picture that is gone', {'docs/a.md': '![a](images/a.png)\n'}, 'docs/a.md:1: there is no images/a.png'),
    ('a folder', {'docs/a.md': '[b](../examples)\n', 'examples/a.sh': ''}, None),
    ('code is no link', {'docs/a.md': '    [a](b.md)\n\n```\n[a](b.md)\n```\n`[a](b.md)`\n'}, None),
    ('another site', {'docs/a.md': '[a](https://example.org/b.md)\n'}, None),
    ('a source that names a page', {'docs/a.md': '', 'src/a.cpp': '// docs/a.md says why.\n'}, None),
    ('a source that names a page that is gone', {'docs/a.md': '', 'src/a.cpp': '\n// docs/b.md says why.\n'}, 'src/a.cpp:2: there is no docs/b.md'),
    ('no page', {'src/a.cpp': ''}, 'check_links: 0 pages'),
]

sys.exit(trees.run(sys.argv[1], CASES))
