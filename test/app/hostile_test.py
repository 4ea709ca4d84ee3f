"""Words and files that nobody should give: one line that says what is wrong, the exit status for it, and no file written or lost."""
import os
import subprocess

from program import HANGS, PROGRAM, good, main, read, refused, run, says

VERBS = [line.split()[0] for line in good('--help').split('Verbs:\n')[1].split('\n\n')[0].splitlines()]
WITH_MODEL = [verb for verb in VERBS if 'MODEL' in good(verb, '--help')]
NEEDED = {'diagram': ['--sweep', 'omega=1:2:2', '--impacts', '1'], 'map': ['--x', 'omega=1:2:2', '--y', 'clearance=0:1:2'], 'basins': ['--x', 'x1=-1:0:2', '--y', 'v1=-1:0:2'], 'measure': ['--of', 'x1'], 'spectrum': ['--of', 'x1'], 'continue': ['--param', 'omega', '--range', '1:2'], 'curve': ['--params', 'omega,damping_ratio', '--range', 'omega=1:2', '--range', 'damping_ratio=0:1']}
SMALL = 'name = "m"\n[[coordinate]]\nname = "x"\nmass = 1\n'


def write(name, content):
    with open(name, 'wb') as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def checked(content):
    """The message about a file of this content, without the program's name; '' if it is a sound model."""
    write('f.toml', content)
    done = run('check', 'f.toml')
    assert done.status in (0, 2) and done.err.count('\n') == (done.status != 0), (content[:200], done.status, done.err)
    assert done.status == 0 or done.err.startswith('slapstick: f.toml:'), done.err
    return done.err[len('slapstick: '):]


def test_a_file_that_was_cut_off_is_a_model_or_an_error():
    for model in ('vibro-impact', 'two-sided-rattle', 'gear-pair'):
        whole = good('show', model).encode()
        assert checked(whole) == ''
        for length in range(0, len(whole), 149):
            checked(whole[:length])


def test_bytes_that_are_no_text():
    assert checked(b'\xef\xbb\xbf' + SMALL.encode().replace(b'\n', b'\r\n')) == ''  # what Windows editors write
    assert checked(b'\xff\xfe' + SMALL.encode('utf-16-le')).startswith('f.toml:1: ')
    assert checked(SMALL + '\0').startswith('f.toml:5: a NUL byte')
    assert checked(SMALL.encode() + b'notes = "\xc3"').startswith('f.toml:5: ')
    assert checked(SMALL.encode() + b'# \x80').startswith('f.toml:5: ')
    assert checked(SMALL.replace('\n', '\r')).startswith('f.toml:1: ')


def test_sizes_that_would_exhaust_a_parser():
    for deep in ('a = ' + '[' * 1000000, 'a = ' + '[\n' * 1000000, 'a = ' + '{a=' * 1000000, '[' + 'a.' * 1000000 + 'a]',
                 '\n'.join(['[[a]]'] * 1000000), 'a = """' + '\n"' * 400000, '#' * 1000000, 'name = "' + 'x' * 1000000 + '"'):
        assert checked(deep) != '', deep[:20]
    with open('f.toml', 'wb') as file:
        file.truncate(1 << 30)
    says(refused(2, 'check', 'f.toml'), 'f.toml: larger than 1048576 bytes')


def test_numbers_that_are_none():
    mass = SMALL[:-2]
    for number in ('0x1p3', '1e999', '-1e999', '99999999999999999999', '-9223372036854775809', '0,5', '1_', '01', '1.', '.5e', 'NaN', '+-1', '1f', '٣',
                   '0x8000000000000000', '"0x1p3"', '"1e999"', '"1e999 - 1e999"', '"0,5"', '"1 2"', '"0b1"', '"1/0"', '""'):
        assert checked(mass + number + '\n').startswith('f.toml:4: '), number
    for number in ('1e3', '0x1F', '0o17', '0b1', '1_000', '+1.5', '"1e3"', '9223372036854775807'):
        assert checked(mass + number + '\n') == '', number
    for number in ('inf', 'nan', '1e-400', '-0.0', '1e51'):
        assert checked(mass + number + '\n').startswith('f.toml:4: coordinate \'x\': mass'), number


def test_the_locale_does_not_change_a_number():
    write('f.toml', SMALL.replace('1\n', '1.5\n'))
    for locale in ('de_DE.UTF-8', 'C', 'tr_TR.UTF-8'):
        done = run('show', 'f.toml', env={'LC_ALL': locale, 'LANG': locale})
        assert done.status == 0 and 'mass = 1.5' in done.out


def test_every_verb_refuses_words_that_it_does_not_know():
    long = 'x' * 100000
    for verb in VERBS:
        for words in (['--nosuch'], ['--nosuch=3'], ['-x'], ['a', 'b', 'c'], ['--', '--nosuch', 'b'], [b'\xff\xfe', 'b'], [long, long],
                      ['--' + long], ['-' + '\n'], ['vibro-impact', '']):
            line = refused(2, verb, *words)
            assert len(line) < 1000 and line[:-1].isprintable(), (verb, line[:200])
    for verb in WITH_MODEL:
        none = [] if '[MODEL]' in good(verb, '--help') else ['--']  # where a model may be left out, -- alone leaves it out
        for model in ('', '-', *none, b'\xff', long, 'VIBRO-IMPACT', 'vibro-impact '):
            assert refused(2, verb, model)[:-1].isprintable(), (verb, model)
        for file in (b'\xff.toml', long + '.toml', '.toml', 'a\nb.toml', '..', '/', '~.toml'):
            assert refused(4, verb, file, *NEEDED.get(verb, []))[:-1].isprintable(), (verb, file)


def test_options_that_are_given_twice_or_without_a_value():
    for verb in WITH_MODEL:
        for line in good(verb, '--help').splitlines():
            option = line.split()[0] if line.strip().startswith('--') else ''
            if option in ('', '--help', '--set') or ' ' not in line.strip():
                continue
            takes_value = not line.split()[1].islower() or '|' in line.split()[1]
            if takes_value:
                says(refused(2, verb, 'vibro-impact', option), option)
                repeated = (option == '--stop' and verb != 'simulate') or option in ('--inset', '--sensitivity') or (verb, option) in (('curve', '--range'), ('curve', '--from'))
                if not repeated:
                    says(refused(2, verb, 'vibro-impact', option, '1', option, '1'), option)


def test_a_curve_has_one_range_for_each_of_its_parameters():
    words = ('curve', 'vibro-impact', '--params')
    says(refused(2, *words, 'ome\nga,friction', '--range', 'omega=2:3'), "--range: 'omega' is not one of --params 'ome\\x0aga,friction'")
    says(refused(2, *words, 'omega,\n', '--range', 'omega=2:3'), "--range: give '\\x0a=A:B' too")
    says(refused(2, *words, 'omega,friction', '--range', 'omega=2:3', '--range', 'omega=3:4'), "--range: 'omega' is given twice")
    says(refused(2, *words, 'omega,omega', '--range', 'omega=2:3'), '--params', 'two different parameters')


def test_files_that_cannot_be_what_they_are_for():
    os.mkdir('folder.toml')
    os.mkfifo('pipe.toml')
    os.symlink('loop.toml', 'loop.toml')
    for verb in WITH_MODEL:
        for name in ('folder.toml', 'pipe.toml', 'loop.toml', '/dev/null.toml', 'none.toml'):
            says(refused(4, verb, name, *NEEDED.get(verb, [])), name)
    for verb in ('show', 'simulate', 'classify'):
        says(refused(4, verb, 'impact-oscillator', '--out', 'folder.toml'), 'folder.toml')
        says(refused(4, verb, 'impact-oscillator', '--out', '/proc/self/none'), '/proc/self/none')
        says(refused(4, verb, 'impact-oscillator', '--out', 'x' * 300), 'x' * 100)
        says(refused(4, verb, 'impact-oscillator', '--out', 'none/'), 'none/')
    assert sorted(os.listdir('.')) == ['folder.toml', 'loop.toml', 'pipe.toml']


def test_the_model_file_is_never_overwritten_by_a_result():
    write('m.toml', good('show', 'impact-oscillator'))
    os.symlink('m.toml', 'link.toml')
    before = read('m.toml')
    for verb in WITH_MODEL:
        if '--out' not in good(verb, '--help'):
            continue
        for out in ('m.toml', './m.toml', 'link.toml', os.path.abspath('m.toml')):
            says(refused(2, verb, 'm.toml', *NEEDED.get(verb, []), '--out', out), '--out', 'MODEL')
            assert read('m.toml') == before


def test_combinations_of_options_that_make_no_sense():
    says(refused(2, '--help', 'more'), "'more'")
    says(refused(2, 'simulate', 'vibro-impact', '--plot', 'p.gif'), '--plot', '.png')
    says(refused(2, 'poincare', 'vibro-impact', '--phase', '0.5'), '--phase', 'stroboscopic')
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:1000000', '--impacts', '1000'), '--sweep', '--impacts 1000', 'rows')
    assert os.listdir('.') == []


def test_a_start_of_ones_own_where_the_models_own_does_not_fit():
    words = ('simulate', 'vibro-impact', '--set', 'clearance=-1', '--periods', '2')
    says(refused(2, *words), '--set clearance=-1')
    says(good(*words, '--state', 'x1=-2,x2=0'), '"complete": true')


def test_closed_standard_streams_take_no_file():
    """A file that is opened as descriptor 1 would get what is meant for standard output."""
    for closed in (0, 1, 2):
        done = subprocess.run([PROGRAM, 'simulate', 'impact-oscillator', '--periods', '3', '--events', 'e.csv', '--out', 'o.json'],
                              preexec_fn=lambda: os.close(closed), check=False, timeout=HANGS)
        assert done.returncode == 0 and read('e.csv').startswith('time,kind') and read('o.json').startswith('{')


def test_a_picture_of_every_section():
    for words in (['--section', 'stroboscopic'], ['--section', 'impact']):
        good('poincare', 'vibro-impact', '--set', 'omega=4.9', '--points', '20', *words, '--plot', 'p.png', '--out', 'p.csv')
        assert os.path.getsize('p.png') > 1000


main({name: case for name, case in globals().items() if name.startswith('test_')})
