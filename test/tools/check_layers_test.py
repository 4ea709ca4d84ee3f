"""tools/check_layers must find each kind of violation, and only violations."""
import os
import sys

import trees

CHECK = sys.argv[1]
with open(os.path.join(os.path.dirname(CHECK), '../docs/developers/architecture.md'), encoding='utf-8') as file:
    DOCUMENT = file.read()


def tree(path, line, **extra):
    """A tree with `line` in the file `path`; `document` replaces docs/developers/architecture.md."""
    files = {
        'docs/developers/architecture.md': extra.get('document', DOCUMENT),
        'include/slapstick/model/model.hpp': '#pragma once\n#include <vector>\n',
        'src/flow/private.hpp': '#pragma once\n',
        'src/sweep/private.hpp': '#pragma once\n',
    }
    files[path] = '// first line\n' + line + '\n'
    return files


def linked(call):
    """A tree with the folders base and model, the latter by this call."""
    return dict(tree('src/model/CMakeLists.txt', ''), **{'src/model/CMakeLists.txt': call + '\n',
                                                         'src/base/CMakeLists.txt': 'slapstick_folder(base SOURCES text.cpp)\n'})


CASES = [
    ('downwards', tree('src/flow/motion.cpp', '#include "slapstick/model/model.hpp"'), None),
    ('own folder', tree('src/flow/motion.cpp', '#include "private.hpp"'), None),
    ('own folder by its name', tree('src/flow/motion.cpp', '#include "flow/private.hpp"'), None),
    ('the program uses everything', tree('apps/slapstick/main.cpp', '#include "slapstick/sweep/diagram.hpp"'), None),
    ('a system header', tree('src/flow/motion.cpp', '#include <cmath>'), None),
    ('TBB in sweep', tree('src/sweep/run.cpp', '#include <tbb/parallel_for.h>'), None),
    ('a comment', tree('src/model/model.cpp', '// #include "slapstick/flow/motion.hpp"'), None),

    ('upwards', tree('src/model/model.cpp', '#include "slapstick/flow/motion.hpp"'),
     "src/model/model.cpp:2: model may not include flow ('slapstick/flow/motion.hpp')"),
    ('upwards in a public header', tree('include/slapstick/event/root.hpp', '#include <slapstick/model/model.hpp>'),
     'include/slapstick/event/root.hpp:2: event may not include model'),
    ('upwards to a private header', tree('src/mode/mode.cpp', '#include "flow/private.hpp"'), 'mode may not include flow'),
    ('upwards by a relative path', tree('src/mode/mode.cpp', '#include "../flow/private.hpp"'), 'mode may not include flow'),
    ('upwards with spaces', tree('src/mode/mode.cpp', '  #  include  "flow/private.hpp"'), 'mode may not include flow'),
    ('a header that does not exist yet', tree('src/mode/mode.cpp', '#include "flow/later.hpp"'), 'mode may not include flow'),
    ('figure computes no dynamics', tree('src/figure/raster.cpp', '#include "slapstick/flow/motion.hpp"'),
     'figure may not include flow'),
    ('public header includes a private one', tree('include/slapstick/flow/motion.hpp', '#include "flow/private.hpp"'),
     'public header includes the private'),
    ('program includes a private header', tree('apps/slapstick/main.cpp', '#include "flow/private.hpp"'),
     "program includes the library's private"),
    ('program includes a private tool', tree('apps/slapstick/main.cpp', '#include "io/private.hpp"'), None),
    ('public header with vector instructions', tree('include/slapstick/flow/motion.hpp', '#include <immintrin.h>'),
     'public header includes <immintrin.h>'),
    ('a decomposition elsewhere', tree('src/flow/motion.cpp', '#include <Eigen/SVD>'), 'decompositions are compiled once'),
    ('the umbrella has all', dict(tree('include/slapstick/flow/motion.hpp', '#include <cmath>'), **{
        'include/slapstick/slapstick.hpp': '#include "slapstick/flow/motion.hpp"\n#include "slapstick/model/model.hpp"\n'}), None),
    ('the umbrella lacks one', dict(tree('include/slapstick/flow/motion.hpp', '#include <cmath>'),
                                    **{'include/slapstick/slapstick.hpp': '#pragma once\n'}),
     "slapstick.hpp: does not include 'slapstick/flow/motion.hpp'"),
    ('a folder linked with what its includes lead to', linked('slapstick_folder(model NEEDS base SOURCES model.cpp)'), None),
    ('a folder linked with too little', linked('slapstick_folder(model SOURCES model.cpp)'),
     "src/model/CMakeLists.txt: model is linked with ['model'], but its includes lead to ['base', 'model']"),
    ('a folder linked with what is none', linked('slapstick_folder(model NEEDS bace SOURCES model.cpp)'),
     'src/model/CMakeLists.txt: model needs bace, which is no folder'),
    ('TBB elsewhere', tree('apps/reproduce/study.cpp', '#include <tbb/parallel_for.h>'), 'oneTBB belongs to sweep'),
    ('oneapi/tbb elsewhere', tree('src/flow/motion.cpp', '#include <oneapi/tbb.h>'), 'oneTBB belongs to sweep'),
    ('threads before sweep', tree('src/flow/motion.cpp', '#include <thread>'), 'threads belong to sweep'),
    ('files before sweep', tree('src/model/model.cpp', '#include <fstream>'), 'files belong to io'),
    ('printing', tree('src/io/table.cpp', '#include <iostream>'), 'never prints'),
    ('a folder outside the table', tree('src/helpers/all.cpp', '#include <cmath>'), "folder 'helpers' is not in the table"),
    ('the document says otherwise', tree('src/flow/motion.cpp', '', document=DOCUMENT.replace('| base, io |', '| base |')),
     "'figure' may include ['base'], but tools/check_layers says ['base', 'io']"),
    ('the document has no table', tree('src/flow/motion.cpp', '', document='nothing here\n'), "folder 'flow' is only in tools/check_layers"),
    ('nothing to check', {'docs/developers/architecture.md': DOCUMENT}, 'no C++ file'),
]

sys.exit(trees.run(CHECK, CASES))
