"""tools/check_portable must find what libc++ 14 lacks, where it is used, and only there."""
import sys

import trees

RANGES, NUMBERS = 'take base/ranges.hpp', 'take base/decimal.hpp'

CASES = [
    ('an algorithm', {'src/a/b.cpp': '#include <algorithm>\nauto x = std::ranges::find(v, 1);\n'}, f"src/a/b.cpp:2: 'std::ranges': libc++ 14 has no std::ranges: {RANGES}"),
    ('a view', {'include/slapstick/a.hpp': 'auto x = v | std::views::reverse;\n'}, RANGES),
    ('its header', {'apps/a/b.cpp': '#include <ranges>\n'}, RANGES),
    ('ours', {'src/a/b.cpp': 'auto x = ranges::find(v, 1);\n'}, None),
    ('a number to text', {'src/a/b.cpp': 'std::to_chars(a, b, x);\n'}, NUMBERS),
    ('text to a number', {'apps/a/b.cpp': 'using std::from_chars;\n'}, NUMBERS),
    ('the header of both', {'src/a/b.hpp': '# include <charconv>\n'}, NUMBERS),
    ('the file for it', {'src/base/decimal.cpp': '#include <charconv>\nauto x = std::to_chars(a, b, 1.0);\n'}, None),
    ('not everything there', {'src/base/decimal.cpp': 'std::ranges::sort(v);\n'}, RANGES),
    ('a format', {'src/a/b.cpp': 'std::format("{}", x);\n'}, 'libc++ 14 lacks it'),
    ('long double', {'src/a/b.cpp': 'long  double x;\n'}, 'src/a/b.cpp:1: '),
    ('a line after a comment', {'src/a/b.cpp': '/* a\n b */\n__float128 x;\n'}, "src/a/b.cpp:3: '__float128'"),
    ('in a comment', {'src/a/b.cpp': '// std::ranges, long double\nint x;  /* to_chars */\n'}, None),
    ('in a text', {'src/a/b.cpp': 'auto s = "std::to_chars \\" std::ranges";\nauto r = R"x(long double)x";\n'}, None),
    ('nothing', {'README': ''}, '0 files'),
]

sys.exit(trees.run(sys.argv[1], CASES))
