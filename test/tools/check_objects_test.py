"""tools/check_objects notices an inline function left over, a strange name, instructions of another target, and a cosine of the C library."""
import os
import subprocess
import sys
import tempfile

CHECK, COMPILER = sys.argv[1:3]
SOUND = 'namespace sse4 { void twice(double* x) { for (int i = 0; i < 8; ++i) x[i] *= 2; } }\n'


def verdict(text, target, *flags):
    with tempfile.TemporaryDirectory() as folder:
        source, path = os.path.join(folder, 'a.cpp'), os.path.join(folder, 'a.o')
        with open(source, 'w', encoding='utf-8') as file:
            file.write(text)
        subprocess.run([COMPILER, '-O2', *flags, '-c', source, '-o', path], check=True)
        run = subprocess.run([sys.executable, '-B', CHECK, target, path], capture_output=True, text=True, check=False)
        return run.returncode, run.stdout


def expect(part, text, target, *flags):
    status, said = verdict(text, target, *flags)
    assert status == 1 and part in said, (part, status, said)


assert verdict(SOUND, 'sse4')[0] == 0, verdict(SOUND, 'sse4')
with tempfile.TemporaryDirectory() as tree:
    objects = os.path.join(tree, 'src', 'flow', 'CMakeFiles')
    os.makedirs(objects)
    for text, status in (('double f(double x) { return __builtin_sqrt(x) * 2; }', 0), ('double f(double x) { return __builtin_cos(x); }', 1)):
        made = os.path.join(objects, 'a.o')
        subprocess.run([COMPILER, '-O2', '-x', 'c++', '-', '-c', '-o', made], input=text, text=True, check=True)
        assert subprocess.run([sys.executable, '-B', CHECK, 'arithmetic', made], capture_output=True, check=False).returncode == status, text
expect('may take', SOUND + 'inline double shared(double x) { return x + 1; }\nnamespace sse4 { double (*f())(double) { return shared; } }\n', 'sse4')
expect('not sse4 in its name', SOUND + 'double stray(double x) { return x; }\n', 'sse4')
expect('has AVX', SOUND, 'sse4', '-mavx', '-mprefer-vector-width=128')
expect('widest registers are xmm', SOUND.replace('sse4', 'avx512'), 'avx512')
expect('fused', 'namespace avx2 { void f(double* x, double* y) { for (int i = 0; i < 8; ++i) x[i] = x[i] * y[i] + 3; } }\n', 'avx2',
       '-mavx2', '-mfma', '-ffp-contract=fast', '-O3')
