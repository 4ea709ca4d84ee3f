"""The tables of simulate where several events share an instant. One CTest case per function `test_...`; named after its danger."""
from program import good, main, read, table


def test_events_of_one_instant_have_each_its_own_state():
    with open('row.toml', 'w', encoding='utf-8') as file:
        file.write('name = "row"\nimpact_law = "sequence"\n' + ''.join('[[coordinate]]\nname = "%s"\nmass = 1\n' % x for x in 'abc') + ''.join(
            '[[stop]]\nname = "%s"\nbetween = ["%s", "%s"]\nclearance = 0\nrestitution = 1\n' % (x + y, x, y) for x, y in ('ab', 'bc')))
    good('simulate', 'row.toml', '--state', 'a=-0.5,v_a=1', '--periods', '1', '--events', 'e.csv', '--out', 'o.json')
    columns, rows = table(read('e.csv'))
    assert [row[:4] for row in rows] == [['0.5', 'impact', 'ab', '1'], ['0.5', 'impact', 'bc', '1'], ['0.5', 'stick', 'ab', '0']], rows
    speeds = [[row[columns.index('v_' + x)] for x in 'abc'] for row in rows]
    assert speeds == [['1', '0', '0'], ['0', '1', '0'], ['0', '0', '1']], speeds


def test_the_first_row_of_a_trajectory_has_the_mode_that_starts():
    for length in ('0', '1'):  # the impact is due at once, and turns the direction of slip
        good('simulate', 'vibro-impact', '--state', 'x1=0,v1=1', '--periods', length, '--trajectory', 't.csv', '--samples', '4', '--events', 'e.csv', '--out', 'o.json')
        assert table(read('t.csv'))[1][0][-1] == 'slip-'
        assert table(read('e.csv'))[1][0][:2] == ['0', 'impact']


if __name__ == '__main__':
    main({name: case for name, case in globals().items() if name.startswith('test_')})
