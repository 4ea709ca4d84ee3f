"""What a user's compiler reads of slapstick: only installed headers, none that depends on the instruction set.

    headers_test.py PREFIX COMPILER...

Each installed header is compiled alone by the first compiler, with all warnings as errors and the definitions that the package gives.
The others read the same standard library: they are given all headers in one text, twice.
"""
import concurrent.futures
import os
import re
import subprocess
import sys

FLAGS = ['-std=c++20', '-Wall', '-Wextra', '-Wpedantic', '-Werror', '-fsyntax-only', '-x', 'c++', '-']
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
VECTORS = re.compile(r'\w*intrin\.h|arm_neon|vector_size|__builtin_shuffle|__AVX|__SSE|__ARM_NEON|-march')


def headers(root):
    for folder, _, names in sorted(os.walk(os.path.join(root, 'slapstick'))):
        for name in sorted(names):
            yield os.path.relpath(os.path.join(folder, name), root)


def of_package(prefix):
    """Definitions and include folders that slapstick::slapstick gives its users."""
    for folder, _, names in os.walk(prefix):
        if 'slapstick-targets.cmake' in names:
            with open(os.path.join(folder, 'slapstick-targets.cmake'), encoding='utf-8') as file:
                defined = re.search(r'INTERFACE_COMPILE_DEFINITIONS "([^"]*)"', file.read())
            return ['-D' + each for each in defined[1].split(';')] if defined else []
    sys.exit(f'no package under {prefix}')


def read_faults(root, header, public):
    with open(os.path.join(root, header), encoding='utf-8') as file:
        text = file.read()
    for quote, name in INCLUDE.findall(text):
        if name not in public and (quote == '"' or name.startswith('slapstick/')):
            yield f'{header} includes {name}, which is not installed'
    for found in VECTORS.findall(text):
        yield f'{header} has {found}: what it declares would depend on the compiler\'s flags'


def compile_fault(compiler, flags, headers):
    """What the compiler says of a text that includes these headers, and then again; None if nothing."""
    text = ''.join(f'#include "{header}"\n' for header in [*headers, *headers]) + 'int main() {}\n'
    run = subprocess.run([compiler, *flags, *FLAGS], input=text, text=True, capture_output=True, check=False)
    what = f'{headers[0]} alone' if len(headers) == 1 else 'all headers'
    return f'{compiler}: {what}:\n{run.stderr[:3000]}' if run.returncode != 0 else None


def main(prefix, first, *others):
    root = os.path.join(prefix, 'include')
    public = set(headers(root))
    faults = [fault for header in sorted(public) for fault in read_faults(root, header, public)]
    eigen = os.environ.get('EIGEN', '/usr/include/eigen3')
    flags = of_package(prefix) + ['-I' + root, '-isystem', eigen]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        texts = [(first, [header]) for header in sorted(public)] + [(other, sorted(public)) for other in others]
        jobs = [pool.submit(compile_fault, compiler, flags, text) for compiler, text in texts]
        faults += filter(None, (job.result() for job in jobs))
    for fault in faults:
        print(fault)
    print(f'{len(public)} headers, {1 + len(others)} compilers, {len(faults)} faults')
    return 1 if faults or len(public) < 2 else 0


sys.exit(main(*sys.argv[1:]))
