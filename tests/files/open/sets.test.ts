import { describe, expect, it } from 'vitest';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import type { SetsByName } from '../../../src/model/sets-by-name.ts';
import { file, joint, skeleton, skelFile } from '../../helpers/builders.ts';
import { only, open } from './opening.ts';

const sets = (path: string, more: Partial<SetsByName> = {}) =>
  file(path, { kind: 'sets', sets: { sets: [{ name: 'all', joints: ['#1', 'joint0'] }], locked: [], ...more } });

describe('selection sets and locks beside a skeleton', () => {
  const hero = skelFile('hero.skel', skeleton());

  it('they are given to the skeleton with the longest name that begins theirs, in one drop or later', () => {
    const long = skelFile('hero_big.skel', skeleton(3, 'hero_big'));
    const { document } = open([hero, long, sets('Hero_big_2.sets.json')]);
    expect(document.characters.map((c) => c.sets?.sets[0].joints)).toEqual([undefined, [0, 1]]);
    const later = open([sets('hero.sets.json')], document).document;
    expect(later.characters.map((c) => c.sets?.sets[0].joints)).toEqual([
      [0, 1],
      [0, 1],
    ]);
  });

  it('those of a skeleton that is not open wait for it', () => {
    const { document, diagnostics } = open([sets('hero.sets.json')]);
    expect(diagnostics[0].message).toContain('No open skeleton');
    expect(only(open([hero], document).document).sets?.sets).toHaveLength(1);
  });

  it('joints and DOFs that the skeleton lacks are left out, each told with its path', () => {
    const locked = [
      { joint: 'joint1', dofs: ['rz', 'ty'] },
      { joint: 'tail', dofs: ['rx'] },
    ];
    const given = sets('hero.sets.json', { sets: [{ name: 'tail', joints: ['tail', 'joint1', '#9'] }], locked });
    const { document, diagnostics } = open([hero, given]);
    expect(only(document).sets).toEqual({
      sets: [{ name: 'tail', joints: [1] }],
      locked: [{ joint: 1, dofs: ['rz'] }],
    });
    expect(diagnostics.map(({ code, message }) => `${code} ${message}`)).toEqual([
      'set-joint-unknown locked[0].dofs[1]: hero has not the DOF ty of "joint1".',
      'set-joint-unknown locked[1].joint: hero has not the joint "tail".',
      'set-joint-unknown sets[0].joints[0]: hero has not the joint "tail".',
      'set-joint-unknown sets[0].joints[2]: hero has not the joint "#9".',
    ]);
  });

  it('what is saved reads the same, with joints by index where names repeat', () => {
    const twins = { name: 'hero', joints: [joint(-1), joint(0, { name: 'twin' }), joint(0, { name: 'twin' })] };
    const opened = open([skelFile('hero.skel', twins), sets('hero.sets.json', { others: { by: 'another' } })]);
    const before = only(opened.document);
    const [saved] = saveCharacter(
      { ...before, sets: { sets: [{ name: 'b', joints: [0, 2] }], locked: [{ joint: 2, dofs: ['rx'] }] } },
      'sets',
    );
    expect(saved.name).toBe('hero.sets.json');
    expect(JSON.parse(saved.text)).toEqual({
      sets: [{ name: 'b', joints: ['joint0', '#2'] }],
      locked: [{ joint: '#2', dofs: ['rx'] }],
    });
    expect(saveCharacter(before, 'sets')[0].text).toContain('"by": "another"');
  });
});
