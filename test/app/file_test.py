"""Tables as .npz and .h5: the same numbers as in CSV, with units and parameters."""
import ast
import os
import struct
import zipfile

from program import good, main, read, refused, says, table

KINDS = {'<f8': 'd', '|u1': 'B', '<u4': 'I'}
HAMMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'orbit', 'models', 'hammer-drill.toml')


def array(bytes_):
    """What numpy.load gives: a list, or one value of an array without dimension."""
    assert bytes_[:8] == b'\x93NUMPY\x01\x00', bytes_[:8]
    length = struct.unpack('<H', bytes_[8:10])[0]
    assert (10 + length) % 64 == 0
    head = ast.literal_eval(bytes_[10:10 + length].decode())
    assert head['fortran_order'] is False
    count = head['shape'][0] if head['shape'] else 1
    data = bytes_[10 + length:]
    if head['descr'].startswith('<U'):
        width = 4 * int(head['descr'][2:])
        assert len(data) == width * count
        values = [data[i * width:(i + 1) * width].decode('utf-32-le').rstrip('\0') for i in range(count)]
    else:
        values = list(struct.unpack('<%d%s' % (count, KINDS[head['descr']]), data))
    return values if head['shape'] else values[0]


def npz(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {name[:-len('.npy')]: array(archive.read(name)) for name in archive.namelist()}


def words_of(arrays, column):
    return [arrays[column + '.names'][code] for code in arrays[column]]


def same(arrays, text):
    columns, rows = table(text)
    for k, name in enumerate(columns):
        if name + '.names' in arrays:
            assert words_of(arrays, name) == [row[k] for row in rows], name
        else:
            assert [float(row[k]) for row in rows] == arrays[name], name
    return len(rows)


def test_a_parameter_with_the_name_of_a_column_loses_neither():
    words = ('diagram', 'vibro-impact', '--sweep', 'phase=0.5:1:2', '--impacts', '3', '--out')
    for file in ('p.csv', 'p.npz', 'p.h5'):
        good(*words, file)
    columns, rows = table(read('p.csv'))
    assert columns[0] == 'phase' and columns.count('phase') == 1 and 'phase_2' in columns, columns
    assert {float(row[0]) for row in rows} == {0.5, 1.0}
    assert same(npz('p.npz'), read('p.csv')) == len(rows) > 2


def test_an_npz_file_has_the_numbers_of_the_csv():
    words = ('simulate', 'two-sided-rattle', '--periods', '40', '--out', 's.json')
    good(*words, '--events', 'e.csv', '--trajectory', 't.csv')
    good(*words, '--events', 'e.npz', '--trajectory', 't.npz')
    assert same(npz('e.npz'), read('e.csv')) > 40 and same(npz('t.npz'), read('t.csv')) > 4000
    attributes = npz('e.npz')
    assert attributes['attributes.model'] == 'two-sided-rattle' and attributes['attributes.parameter_omega'] > 0
    for verb in (('poincare', '--points', '50'), ('diagram', '--sweep', 'omega=1:1.2:5', '--impacts', '7', '--direction', 'both')):
        words = (verb[0], 'two-sided-rattle', *verb[1:], '--out')
        good(*words, 'a.csv')
        good(*words, 'a.npz')
        assert same(npz('a.npz'), read('a.csv')) >= 50
    assert 'attributes.parameter_omega' not in npz('a.npz')  # it is a column
    assert os.path.getsize('a.npz') < 1.1 * 8 * 7 * 140 + 8192, os.path.getsize('a.npz')


def test_units_are_in_the_file():
    good('simulate', HAMMER, '--periods', '3', '--trajectory', 't.npz', '--out', 's.json')
    arrays = npz('t.npz')
    units = {name: value for name, value in arrays.items() if name.endswith('.unit')}
    assert units.get('time.unit') == 's' and 'm' in units.values() and 'm/s' in units.values(), units


def test_a_table_that_is_given_up_leaves_the_file_as_it_was():
    good('poincare', 'vibro-impact', '--points', '5', '--out', 'p.npz')
    with open('p.npz', 'rb') as file:
        before = file.read()
    refused(3, 'poincare', 'vibro-impact', '--set', 'clearance=9', '--most-periods', '100', '--out', 'p.npz')
    with open('p.npz', 'rb') as file:
        assert file.read() == before
    assert os.listdir('.') == ['p.npz']


def test_branches_and_curves_are_tables_too():
    words = ('continue', 'vibro-impact', '--set', 'omega=2.9', '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.95')
    text = good(*words)
    for name in ('b.csv', 'b.npz'):
        assert good(*words, '--y', 'F_stop:mean', '--out', name) == ''
    arrays = npz('b.npz')
    assert same(arrays, read('b.csv')) == len(arrays['omega'])
    types = words_of(arrays, 'type')
    points = [value for value, kind in zip(arrays['omega'], types) if kind == 'point']
    special = [(kind, value) for value, kind in zip(arrays['omega'], types) if kind != 'point']
    assert len(points) == text.split('"special": [')[0].count('"param": ') > 10
    for kind, value in special:
        assert '"param": %r' % value in text or '%.12g' % value in text or any(
            abs(float(part.split(',')[0]) - value) < 1e-12 for part in text.split('"param": ')[1:]), (kind, value)
    assert special and all(map(lambda mean: mean == mean, arrays['F_stop:mean'])), special
    words = ('curve', 'vibro-impact', '--set', 'omega=2.2', '--orbit', '1-1', '--params', 'omega,friction', '--range', 'omega=1.3:3', '--range', 'friction=0.1:0.2')
    both = good(*words, '--from', 'PD', '--from', 'SL', '--plot', 'c.png')
    says(both, '"curves": [', '"type": "PD"', '"type": "SL"')
    says(read('c.gp'), "title 'PD'", "title 'SL'", '{/:Italic \u03c9}')
    good(*words, '--from', 'PD', '--from', 'SL', '--out', 'c.npz')
    assert set(words_of(npz('c.npz'), 'curve')) == {'PD', 'SL'}


def test_other_formats_are_refused_before_the_work():
    for name in ('a.mat', 'a.xlsx', 'a.nc'):
        says(refused(2, 'poincare', 'vibro-impact', '--points', '1000000000', '--out', name), name, '.npz or .h5')
    assert os.listdir('.') == []


main({name: case for name, case in globals().items() if name.startswith('test_')})
