"""tools/check_sizes must find each kind of file and function that is too long, and only those."""
import sys

import trees


def lines(count):
    return '// line\n' * count


def body(statements):
    """What follows a function's head: `statements` lines between the braces' lines, statements + 2 in all."""
    return ' {\n' + '  if (x) { y(); }\n' * statements + '}\n'


def function(head, statements):
    return '#pragma once\n\n' + head + body(statements)


def too_long(name, length=51):
    return f'function {name} has {length} lines, the limit is 50'


IN_CLASS = 'namespace a::b {\ntemplate <class T>\nclass Thing final : public Base {\n public:\n  Thing() = default;\n%s};\n}\n'

CASES = [
    ('header at the limit', {'include/slapstick/a.hpp': lines(300)}, None),
    ('header', {'include/slapstick/a.hpp': lines(301)}, 'include/slapstick/a.hpp: 301 lines, the limit is 300'),
    ('private header', {'src/flow/a.hpp': lines(301)}, 'src/flow/a.hpp: 301 lines'),
    ('source at the limit', {'src/flow/a.cpp': lines(400)}, None),
    ('source', {'src/flow/a.cpp': lines(401)}, 'src/flow/a.cpp: 401 lines, the limit is 400'),
    ('verb', {'apps/slapstick/a.cpp': lines(401)}, 'apps/slapstick/a.cpp: 401 lines'),
    ('test', {'test/flow/a_test.cpp': lines(401)}, 'test/flow/a_test.cpp: 401 lines, the limit is 400'),
    ('test header', {'test/flow/a.hpp': lines(301)}, None),

    ('function at the limit', {'src/a.cpp': function('int f(int x)', 48)}, None),
    ('function', {'src/a.cpp': function('int f(int x)', 49)}, 'src/a.cpp:3: ' + too_long('f')),
    ('template', {'src/a.cpp': function('template <class T>\nstd::vector<T> f(T x)', 49)}, too_long('f')),
    ('trailing return', {'src/a.cpp': function('auto f(int x) -> std::vector<int>', 49)}, too_long('f')),
    ('member outside its class', {'src/a.cpp': function('double A::g(int x) const noexcept', 49)}, too_long('A::g')),
    ('operator', {'src/a.cpp': function('A& A::operator=(const A& b)', 49)}, too_long('A::operator=')),
    ('constructor with initialisers', {'src/a.cpp': function('A::A(int x) : a(x), b{x}, c(f(x))', 49)}, too_long('A::A')),
    ('constructor that ends in braces', {'src/a.cpp': function('A::A(int x) : B<int>{x}, a{1}', 49)}, too_long('A::A')),
    ('member in its class', {'src/a.hpp': IN_CLASS % ('  void h() const' + body(49))}, too_long('h')),
    ('test case', {'test/a.cpp': function('TEST(Suite, name_of_case)', 49)}, too_long('TEST(Suite, name_of_case)')),
    ('lambda at namespace level', {'src/a.cpp': function('const auto k = [](int x)', 49).replace('}\n', '}\n', 1)}, 'has 51 lines'),
    ('function after an array', {'src/a.cpp': 'int a[] = {1, 2};\nA b{3};\n' + function('int f()', 49)}, too_long('f')),
    ('function after literals', {'src/a.cpp': "char c = '{'; auto s = \"{\"; int n = 1'000'000; // {\n"
                                              'auto r = R"x({ " { )x"; /* { */\n' + function('int f()', 49)}, too_long('f')),

    ('long class of short functions', {'src/a.hpp': IN_CLASS % ('  int f() { return 1; }\n' * 60)}, None),
    ('long namespace of short functions', {'src/a.cpp': 'namespace {\n' + 'int f() {\n  return 1;\n}\n' * 30 + '}\n'}, None),
    ('long table', {'src/a.cpp': 'constexpr int table[] = {\n' + '  1,\n' * 80 + '};\n'}, None),
    ('braces in a comment', {'src/a.cpp': '/* void f() {\n' + '\n' * 60 + '} */\n'}, None),
    ('script', {'test/a_test.py': '# line\n' * 401}, 'test/a_test.py: 401 lines, the limit is 400'),
    ('script with braces', {'test/a_test.py': 'a = {\n' + '    1: 2,\n' * 80 + '}\n'}, None),
    ('function of a script at the limit', {'test/a_test.py': 'def f():\n' + '    pass\n' * 49}, None),
    ('function of a script', {'test/a_test.py': '\ndef f():\n' + '    pass\n' * 50}, 'test/a_test.py:2: ' + too_long('f')),
    ('method of a script', {'test/a_test.py': 'class A:\n    def f(self):\n' + '        pass\n' * 50}, 'test/a_test.py:2: ' + too_long('f')),

    ('nothing to check', {'README.md': ''}, 'no C++ or Python file'),
]

sys.exit(trees.run(sys.argv[1], CASES))
