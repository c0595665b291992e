import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { expectClose } from '../helpers/close.ts';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';
import { ikCases } from '../helpers/ik-cases.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

interface IkJson {
  readonly dofs: readonly number[];
  readonly root: readonly number[];
  readonly iterations: number;
  readonly reach?: readonly number[] | 'body';
  readonly pins: readonly {
    readonly joint: number;
    readonly position: readonly number[];
    readonly residual: number;
  }[];
}

/** Two arms of two bones of length 1, with a limit at one elbow; both ends are called "hand". */
const ARMS = `balljoint body {
  balljoint upper { offset 1 0 0
    hingejoint elbow { offset 0 1 0 axis 1 0 0 limit r 0 1
      fixedjoint hand { offset 0 1 0 }
    }
  }
  balljoint upper@2,a=b { offset -1 0 0
    fixedjoint hand { offset 0 1 0 }
  }
}
`;

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  writeFileSync(join(folder, 'arms.skel'), ARMS);
  writeFileSync(join(folder, 'broken.skel'), 'balljoint root {');
});
afterAll(() => rmSync(folder, { recursive: true }));

const ikOf = (...args: string[]) => commandJson<IkJson>(['ik', 'arms.skel', ...args], folder);
const told = async (...args: string[]) => {
  const { code, err } = await command(['ik', ...args], folder);
  expect(code).toBe(2);
  return err.split('\n')[0];
};

describeShared('marrow ik, against the reference', () => {
  it('tells which joints bend, and bends no others', async () => {
    const file = sharedPath('data/cse169/wasp.skel');
    const solved = (...reach: string[]) =>
      commandJson<IkJson>(['ik', file, '--pin', '#6=0,0.2,-1.5', ...reach], folder);
    const limb = await solved('--reach', 'limb');
    expect(limb.reach).toEqual([2, 3, 4, 5, 6]);
    const chain = await solved('--reach', 'chain:#4');
    expect(chain.reach).toEqual([4, 5, 6]);
    expect((await solved('--reach', 'body')).reach).toBe('body');
    const all = await solved();
    expect(all.reach).toBeUndefined();
    for (const { root } of [limb, chain]) expect(root).toEqual(all.root);
    expect(await told(file, '--pin', '#6=0,0,0', '--reach', 'arm')).toContain(
      '--reach takes limb, body or chain:JOINT',
    );
    expect(await told(file, '--pin', '#6=0,0,0', '--reach', 'body', '--free-root')).toContain(
      "can't be used with --reach",
    );
  });

  it('brings tips of axis-angle skeletons to reachable targets', async () => {
    const cases = ikCases();
    for (const [name, list] of Object.entries(cases.multi)) {
      const { file, reach } = cases.skeletons[name];
      const targets = list[0];
      const pins = targets.flatMap(([joint, ...at]) => ['--pin', `#${joint}=${at.join(',')}`]);
      const data = sharedPath('data/axis-skel');
      const { dofs, root, pins: found } = await commandJson<IkJson>(['ik', file, ...pins], data);
      expect(root).toEqual([0, 0, 0]);
      const posed = await commandJson<PoseJson>(['pose', file, `--dofs=${dofs.join(',')}`], data);
      targets.forEach(([joint, ...at], p) => {
        expect(found[p].joint).toBe(joint);
        expect(found[p].residual).toBeLessThanOrEqual(cases.tolerance * reach);
        expectClose(found[p].position, at, cases.tolerance * reach);
        expectClose(found[p].position, posed.characters[0].joints[joint].tip ?? [], 1e-12);
      });
    }
  });
});

describe('marrow ik', () => {
  it('finds a pose whose points pose confirms, within the limits', async () => {
    const { dofs, root, pins, iterations } = await ikOf('--pin', '#3=1.4,1.2,0.5');
    expect(iterations).toBeGreaterThan(0);
    expect(pins[0].residual).toBeLessThan(1e-4);
    expect(root).toEqual([0, 0, 0]);
    expect(dofs[6]).toBeGreaterThanOrEqual(0);
    expect(dofs[6]).toBeLessThanOrEqual(1);
    const { characters } = await commandJson<PoseJson>(['pose', 'arms.skel', `--dofs=${dofs.join(',')}`], folder);
    expectClose(characters[0].joints[3].world.slice(12, 15), [1.4, 1.2, 0.5], 1e-4);
    expectClose(pins[0].position, characters[0].joints[3].world.slice(12, 15), 1e-12);
  });

  it('pins any point of a joint, whatever characters its name contains', async () => {
    const { pins } = await ikOf('--pin', 'elbow@0,1,0=1.4,1.2,0.5', '--pin=upper@2,a=b@0,0.5,0=-1,0,0.5,0.25');
    expect(pins.map(({ joint }) => joint)).toEqual([2, 4]);
    expect(Math.max(...pins.map(({ residual }) => residual))).toBeLessThan(1e-4);
  });

  it('gets as close as possible, and keeps the root unless that is free', async () => {
    const fixed = await ikOf('--pin', 'upper=9,0,0');
    expectClose(fixed.pins[0].position, [1, 0, 0], 1e-9);
    expect(fixed.pins[0].residual).toBeCloseTo(8, 9);
    const free = await ikOf('--pin', 'upper=9,0,0', '--free-root');
    expect(free.pins[0].residual).toBeLessThan(1e-4);
    expect(free.root[0]).toBeGreaterThan(5);
  });

  it('starts from a given pose, and keeps it if it solves the pins', async () => {
    const dofs = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1];
    const { characters } = await commandJson<PoseJson>(['pose', 'arms.skel', `--dofs=${dofs.join(',')}`], folder);
    const hand = characters[0].joints[3].world.slice(12, 15);
    const found = await ikOf('--dofs', dofs.join(','), '--pin', `#3=${hand.join(',')}`);
    expect(found.dofs).toEqual(dofs);
    expect(found.iterations).toBe(0);
  });

  it('weights decide between two pins on the same joint', async () => {
    const { pins } = await ikOf('--pin', 'upper=2,0,0,100', '--pin', 'upper=0,2,0', '--free-root');
    expect(pins[0].residual).toBeLessThan(pins[1].residual / 50);
  });

  it('prints the same as text and as JSON', async () => {
    const { out, code } = await command(['ik', 'arms.skel', '--pin', 'elbow=1,1,0'], folder);
    expect(code).toBe(0);
    expect(out).toMatch(/^pin on #2 at 1 1 0, off by 0\nroot 0 0 0\ndofs 0,0,0,0,0,0,0,0,0,0\niterations 0\n$/);
  });

  it('reports invalid pins', async () => {
    expect(await told('arms.skel')).toMatch('--pin is missing: JOINT=x,y,z');
    expect(await told('arms.skel', '--pin', 'elbow')).toMatch('has no "="');
    expect(await told('arms.skel', '--pin', 'elbow=1,2')).toMatch('"elbow=1,2" has 2');
    expect(await told('arms.skel', '--pin', 'elbow=1,2,x')).toMatch('found "x"');
    expect(await told('arms.skel', '--pin', 'elbow=1,2,NaN')).toMatch('found "NaN"');
    expect(await told('arms.skel', '--pin', 'elbow=1,2,3,0')).toMatch('weights greater than 0');
    expect(await told('arms.skel', '--pin', 'elbow@1,2=1,2,3')).toMatch('JOINT@x,y,z');
    expect(await told('arms.skel', '--pin', 'knee=1,2,3')).toMatch(/no joint "knee" in "arms".*body, upper, elbow/);
    expect(await told('arms.skel', '--pin', '=1,2,3')).toMatch('There is no joint ""');
    expect(await told('arms.skel', '--pin', '#6=1,2,3')).toMatch('only #0 to #5');
    expect(await told('arms.skel', '--pin', 'hand=1,2,3')).toMatch('use #3 or #5');
  });

  it('reports problems of its files and lists', async () => {
    expect(await told('arms.skel', '--pin', 'elbow=1,2,3', '--dofs', '1,2')).toMatch('takes 10 numbers');
    expect(await told('arms.skel', 'arms.skel', '--pin', 'elbow=1,2,3', '--twice')).toMatch('no option --twice');
    const broken = await command(['ik', 'broken.skel', '--pin', '#0=1,2,3'], folder);
    expect(broken.code).toBe(1);
    expect(broken.err).toMatch('broken.skel:1');
  });
});
