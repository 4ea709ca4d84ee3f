#!/usr/bin/env python3
"""slapstick describe and completion: what is written about the program is what the program takes.

    describe_test.py PROGRAM CASE
"""
import os
import re
import subprocess
import sys
import tempfile

from program import HANGS, PROGRAM, good, main, read, refused

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')


def described():
    return eval(good('describe', '--json'), {'true': True, 'false': False, 'null': None})


def test_the_page_of_all_options_is_what_the_program_writes():
    assert read(os.path.join(ROOT, 'docs', 'reference', 'options.md')) == good('describe', '--markdown')


def test_the_rules_of_python_are_those_of_the_options():
    writer = os.path.join(ROOT, 'tools', 'make_python_rules')
    written = subprocess.run([sys.executable, writer], input=good('describe', '--json'), capture_output=True, text=True, check=True)
    assert read(os.path.join(ROOT, 'python', 'slapstick', '_rules.py')) == written.stdout


def test_every_verb_of_the_help_is_described_and_every_option_is_in_its_help():
    verbs = {verb['name']: verb for verb in described()['verbs']}
    listed = [line.split()[0] for line in good('--help').split('Verbs:\n')[1].split('\n\n')[0].splitlines()]
    assert list(verbs) == listed and len(listed) > 15
    for name, verb in verbs.items():
        shown = good(name, '--help')
        for argument in verb['arguments']:
            assert argument['name'] in shown and argument['help'], (name, argument)
        options = [argument['name'] for argument in verb['arguments']]
        assert len(options) == len(set(options)), name


def test_words_and_bounds_that_are_described_are_those_that_are_taken():
    for verb in described()['verbs']:
        model = ['vibro-impact'] if verb['arguments'] and verb['arguments'][0]['kind'] == 'positional' else []
        for argument in verb['arguments']:
            if argument['kind'] == 'choice':
                assert 'is not one of its words' in refused(2, verb['name'], *model, argument['name'], 'no-such-word')
            if argument['kind'] == 'count':
                line = refused(2, verb['name'], *model, argument['name'], str(argument['most'] + 1))
                assert f"[{argument['least']}, {argument['most']}]" in line, (verb['name'], line)


def given(argument):
    """An option as a user would write it, with a value that is read."""
    kind, name = argument['kind'], argument['name']
    if kind == 'flag':
        return [name]
    if kind == 'choice':
        return [name, argument['words'][0]]
    return [name, str(argument['least']) if kind == 'count' else '0.1']


def needed(verb, argument):
    """What an option needs, by name: the model, what is required, and the first of each group of others."""
    words, names = {}, {one['name']: one for one in verb['arguments']}
    for one in verb['arguments']:
        if one.get('required') and one['name'] != argument['name']:
            words[one['name']] = ['vibro-impact'] if one['kind'] == 'positional' else given(one)
    for group in argument.get('with', []):
        name, _, value = group[0].partition(' ')
        words[name] = [name, value] if value else given(names[name])
    return words


def line_of(words):
    return sum(words.values(), [])


def test_rules_between_options_name_options_that_there_are():
    count = 0
    for verb in described()['verbs']:
        values = {one['name']: one.get('words') for one in verb['arguments']}
        for argument in verb['arguments']:
            for rule in sum(argument.get('with', []), argument.get('without', [])):
                name, _, value = rule.partition(' ')
                assert name in values and name != argument['name'], (verb['name'], rule)
                assert not (value and values[name]) or value in values[name], (verb['name'], rule)
                count += 1
    assert count > 60


def test_an_option_is_refused_without_what_it_needs_and_with_what_it_excludes():
    refusals = 0
    for verb in described()['verbs']:
        names = {one['name']: one for one in verb['arguments']}
        for argument in verb['arguments']:
            option, needs = argument['name'], needed(verb, argument)
            if argument['kind'] == 'positional':
                continue
            if argument.get('required'):
                assert f"{option} {argument['value']} is required" in refused(2, verb['name'], *line_of(needs)), (verb['name'], option)
            for group in argument.get('with', []):
                name, _, value = group[0].partition(' ')
                left = {one: words for one, words in needs.items() if one != name}
                if value:  # another one, not to have it by default
                    left[name] = [name, next(word for word in names[name].get('words', ['carry', 'reset']) if word not in ' '.join(group))]
                line = refused(2, verb['name'], *line_of(left), *given(argument))
                is_required = not value and names[name].get('required')
                assert (f'{name} {names[name].get("value")} is required' if is_required else f"{option}: only with {' or '.join(group)}") in line, (verb['name'], line)
                refusals += 1
            for other in argument.get('without', []):
                name, _, value = other.partition(' ')
                both = {**needs, **needed(verb, names[name]), name: [name, value] if value else given(names[name]), option: given(argument)}
                line = refused(2, verb['name'], *line_of(both))
                assert ': not with ' in line, (verb['name'], line)  # of either, whichever is declared first
                refusals += 1
    assert refusals > 60


def test_numbers_beyond_their_range_are_refused():
    for verb in described()['verbs']:
        for argument in verb['arguments']:
            if 'range' in argument:
                below = argument['range'].strip('([').split(',')[0]
                value = '-1' if below in ('0', '-inf') else str(float(below) - 1)
                line = refused(2, verb['name'], *line_of(needed(verb, argument)), argument['name'], value)
                assert f"{argument['name']}: {value} is outside {argument['range']}" in line, line


def test_quantities_of_a_model_follow_the_rules_that_are_described():
    found = described()
    patterns = [re.escape(rule['name']).replace('NAME', r'\w+') for rule in found['quantities'] if rule['of'] != 'coordinate']
    for one in eval(good('quantities', 'vibro-impact')):
        if one['kind'] in ('displacement', 'velocity', 'acceleration', 'parameter') and not one['name'].startswith('w_'):
            continue
        assert any(re.fullmatch(pattern, one['name']) for pattern in patterns), one
    assert 'rms' in [one['name'] for one in found['statistics']]


def bash_completes(line):
    """What bash offers for the last word of a line."""
    words = line.split(' ')
    script = (f'export PATH={os.path.dirname(PROGRAM)}:$PATH\nsource <(slapstick completion bash)\n'
              f'COMP_WORDS=({" ".join(repr(word) for word in words)})\nCOMP_CWORD={len(words) - 1}\n_slapstick\nprintf "%s\\n" "${{COMPREPLY[@]}}"')
    done = subprocess.run(['bash', '-c', script], capture_output=True, check=True, timeout=HANGS)
    assert done.stderr == b'', done.stderr
    return done.stdout.decode().split()


def test_bash_completes_verbs_options_models_words_and_names():
    assert bash_completes('slapstick meas') == ['measure']
    assert '--sensitivity' in bash_completes('slapstick measure vibro-impact --sens')
    assert 'vibro-impact' in bash_completes('slapstick measure vib')
    assert bash_completes('slapstick diagram vibro-impact --direction b') == ['both']
    assert sorted(bash_completes('slapstick measure vibro-impact --of F_')) == ['F_friction', 'F_stop']
    assert bash_completes('slapstick measure vibro-impact --sensitivity om') == ['omega']


def test_bash_completes_a_list_and_an_assignment_and_a_stop():
    assert bash_completes('slapstick measure vibro-impact --of x1:rms,F_s') == ['x1:rms,F_stop']
    assert bash_completes('slapstick simulate vibro-impact --set om') == ['omega=']
    assert bash_completes('slapstick simulate vibro-impact --stop s') == ['stop']
    assert bash_completes('slapstick curve vibro-impact --params omega,clear') == ['omega,clearance']


def shell_or_nothing(command, script):
    """What a shell prints, or None where it is not installed."""
    try:
        done = subprocess.run(command, input=script.encode(), capture_output=True, check=True, timeout=HANGS,
                              env={**os.environ, 'PATH': os.path.dirname(PROGRAM) + ':' + os.environ['PATH'], 'HOME': os.getcwd()})
    except FileNotFoundError:
        print(f'{command[0]} is not here: its completion is not tried', file=sys.stderr)
        return None
    return done.stdout.decode()


def test_fish_completes_verbs_models_and_names():
    lines = {'slapstick meas': ['measure'], 'slapstick measure shaken-b': ['shaken-belt'], 'slapstick measure vibro-impact --of F_s': ['F_stop'],
             'slapstick measure vibro-impact --of x1:rms,F_s': ['x1:rms,F_stop'], 'slapstick simulate vibro-impact --set om': ['omega='],
             'slapstick simulate vibro-impact --stop s': ['stop'], 'slapstick diagram vibro-impact --direction b': ['both']}
    for line, wanted in lines.items():
        found = shell_or_nothing(['fish', '--no-config'], f"slapstick completion fish | source\ncomplete -C '{line}'\n")
        if found is not None:
            assert [one.split('\t')[0] for one in found.splitlines()] == wanted, (line, found)


def zsh_completes(line):
    """What an interactive zsh makes of a line at the tab key, or None where zsh is not installed."""
    script = ('zmodload zsh/zpty\nzpty shell zsh -f -i\n'
              "zpty -w shell 'PS1=; unsetopt zle_bracketed_paste 2>/dev/null; autoload -Uz compinit; compinit -u -D; source <(slapstick completion zsh)'\n"
              "zpty -w shell 'show() { print -r -- \"<$BUFFER>\"; exit }; zle -N show; bindkey \"^X\" show; print ready-now'\n"
              'while zpty -r shell text; do [[ $text == ready-now* ]] && break; done\n'
              f"zpty -w -n shell $'{line}\\t\\C-x'\n"
              'while zpty -r shell text; do [[ $text == *\\<*\\>* ]] && print -r -- "$text" && break; done\n')
    found = shell_or_nothing(['zsh', '-f'], script)
    return found and re.search(r'<(slapstick [^<>]*)>', found)[1].rstrip()


def test_zsh_completes_verbs_models_and_names():
    lines = {'slapstick meas': 'slapstick measure', 'slapstick measure shaken-b': 'slapstick measure shaken-belt',
             'slapstick measure vibro-impact --of F_s': 'slapstick measure vibro-impact --of F_stop',
             'slapstick measure vibro-impact --of x1:rms,F_s': 'slapstick measure vibro-impact --of x1:rms,F_stop',
             'slapstick simulate vibro-impact --set om': 'slapstick simulate vibro-impact --set omega=',
             'slapstick simulate vibro-impact --stop s': 'slapstick simulate vibro-impact --stop stop'}
    for line, wanted in lines.items():
        found = zsh_completes(line)
        assert found in (None, wanted), (line, found)


def test_scripts_of_zsh_and_fish_are_scripts_where_these_shells_are():
    for shell, check in (('zsh', ['zsh', '-n']), ('fish', ['fish', '--no-execute'])):
        script = good('completion', shell)
        assert 'spectrum' in script
        with tempfile.TemporaryDirectory() as place:
            path = os.path.join(place, 'script')
            with open(path, 'w', encoding='utf-8') as file:
                file.write(script)
            try:
                done = subprocess.run([*check, path], capture_output=True, check=False, timeout=HANGS)
            except FileNotFoundError:
                print(f'{shell} is not here: its script is not looked at', file=sys.stderr)
                continue
            assert done.returncode == 0, done.stderr
    assert 'bash, zsh and fish' in refused(2, 'completion', 'tcsh')


main({name: case for name, case in globals().items() if name.startswith('test_')})
