/**
 * A step of a drag: ours beside closed-chain-ik and three.js's CCDIKSolver (`ik-peers.ts` says how each is set), on the
 * drags of the reference cases that can be followed all the way. To hold: ten times closed-chain-ik's median, about
 * 12 µs for the chain of 30 joints with one pin and 60 µs with several, and no step unsolved.
 *
 * What is printed at the end is of whole paths: each is gone round several times, of each of its steps the shortest
 * time counts, so that what else the machine does counts for none, and of these the median is told; and how many steps
 * left a pin further off than 1e-3 of the reach in the last round. CCD goes round ten times, enough or not.
 * Behind that, clicks: from the pose of the file straight to where random angles put the pins, ours with restarts.
 */
import { afterAll, bench, describe } from 'vitest';
import { caseSkeleton, type IkCases, type IkDrag, ikCases, type Target } from '../helpers/ik-cases.ts';
import { hasShared } from '../helpers/shared.ts';
import { ccd, closedChain, type Dragger, type Grip, ours } from './ik-peers.ts';

const SOLVERS: readonly (readonly [name: string, make: (grip: Grip) => Dragger])[] = [
  ['ours', ours],
  ['closed-chain-ik 0.0.3', closedChain],
  ['the same, aiming as we do', (grip) => closedChain(grip, 1e-4)],
  ["three.js's CCDIKSolver", ccd],
];

function gripOf(cases: IkCases, { skeleton, joint, path, pinned }: IkDrag): Grip {
  return {
    skeleton: caseSkeleton(cases, skeleton),
    reach: cases.skeletons[skeleton].reach,
    targets: [[joint, ...path.slice(0, 3)], ...pinned],
  };
}

const CLICKS: typeof SOLVERS = [['ours', (grip) => ours(grip, 'settle')], ...SOLVERS.slice(1)];

const cases = hasShared ? ikCases() : undefined;
const followed = cases?.drags.filter(({ kind }) => kind === 'free' || kind === 'pinned') ?? [];
const ofChain = (pins: number) => followed.filter((d) => d.skeleton === 'chain30' && d.pinned.length + 1 === pins);

for (const [title, [drag]] of [
  ['30 joints, one pin, a step of a drag', ofChain(1)],
  ['30 joints, three pins, a step of a drag', ofChain(3)],
] as const) {
  describe.skipIf(!cases)(title, () => {
    for (const [name, make] of SOLVERS) {
      const dragger = cases && make(gripOf(cases, drag));
      let step = 0;
      bench(name, () => {
        const at = 3 * (step++ % (drag.path.length / 3));
        dragger?.step(drag.path[at], drag.path[at + 1], drag.path[at + 2]);
      });
    }
  });
}

interface Measured {
  /** Microseconds. */
  readonly median: number;
  readonly steps: number;
  readonly unsolved: number;
}

const ROUNDS = 12;

/** Round and round the path. */
function measure(grip: Grip, path: readonly number[], tolerance: number, dragger: Dragger) {
  const times = Array.from({ length: path.length / 3 }, () => Infinity);
  let unsolved = 0;
  for (let round = 1; round <= ROUNDS; round++) {
    for (let step = 0; step < times.length; step++) {
      const [x, y, z] = path.slice(3 * step, 3 * step + 3);
      const begin = performance.now();
      dragger.step(x, y, z);
      times[step] = Math.min(times[step], 1000 * (performance.now() - begin));
      if (round === ROUNDS && isOff(grip, dragger, tolerance)) unsolved++;
    }
  }
  return { times, unsolved };
}

function isOff(grip: Grip, dragger: Dragger, tolerance: number): boolean {
  return grip.targets.some((_, pin) => !(dragger.off(pin) <= tolerance * grip.reach));
}

function measureAll(all: IkCases, drags: readonly IkDrag[], make: (grip: Grip) => Dragger): Measured {
  const runs = drags.map((drag) => {
    const grip = gripOf(all, drag);
    return measure(grip, drag.path, all.tolerance, make(grip));
  });
  return summary(runs);
}

function summary(runs: readonly { readonly times: readonly number[]; readonly unsolved: number }[]): Measured {
  const times = runs.flatMap((run) => run.times).sort((a, b) => a - b);
  return {
    median: times[times.length >> 1],
    steps: times.length,
    unsolved: runs.reduce((sum, run) => sum + run.unsolved, 0),
  };
}

/** All targets from the pose of the file, a few times over. */
function measureClicks(all: IkCases, grips: readonly Grip[], make: (grip: Grip) => Dragger): Measured {
  const runs = grips.map(() => ({ times: [Infinity], unsolved: 0 }));
  for (let round = 0; round < ROUNDS; round++) {
    grips.forEach((grip, i) => {
      const dragger = make(grip);
      const [[, x, y, z]] = grip.targets;
      const begin = performance.now();
      dragger.step(x, y, z);
      const [least] = runs[i].times;
      runs[i] = {
        times: [Math.min(least, 1000 * (performance.now() - begin))],
        unsolved: isOff(grip, dragger, all.tolerance) ? 1 : 0,
      };
    });
  }
  return summary(runs);
}

function clicksOf(all: IkCases, skeletons: readonly string[], list: 'single' | 'multi'): Grip[] {
  return skeletons.flatMap((name) => {
    const skeleton = caseSkeleton(all, name);
    const { reach } = all.skeletons[name];
    return (all[list][name] ?? []).map((entry) => ({
      skeleton,
      reach,
      // One target is four numbers, several are lists of four.
      targets: list === 'single' ? [entry as Target] : (entry as readonly Target[]),
    }));
  });
}

afterAll(() => {
  if (!cases) return;
  const lines: string[] = [];
  const tell = (title: string, solvers: typeof SOLVERS, measured: (make: (grip: Grip) => Dragger) => Measured) => {
    const rows = solvers.map(([name, make]) => ({ name, ...measured(make) }));
    for (const { name, median, steps, unsolved } of rows) {
      lines.push(
        `  ${title.padEnd(32)} ${name.padEnd(26)} ${median.toFixed(1).padStart(8)} µs` +
          `${(median / rows[0].median).toFixed(1).padStart(8)}×  ${unsolved} of ${steps} unsolved`,
      );
    }
  };
  for (const [title, drags] of [
    ['drag: 30 joints, one pin', ofChain(1)],
    ['drag: 30 joints, 2 and 3 pins', [...ofChain(2), ...ofChain(3)]],
    ['drag: all skeletons, one pin', followed.filter(({ pinned }) => pinned.length === 0)],
    ['drag: all skeletons, several', followed.filter(({ pinned }) => pinned.length > 0)],
  ] as const) {
    tell(title, SOLVERS, (make) => measureAll(cases, drags, make));
  }
  const names = Object.keys(cases.skeletons);
  for (const [title, grips] of [
    ['click: 30 joints, one pin', clicksOf(cases, ['chain30'], 'single')],
    ['click: 30 joints, 2 to 4 pins', clicksOf(cases, ['chain30'], 'multi')],
    ['click: all skeletons, one pin', clicksOf(cases, names, 'single')],
    ['click: all skeletons, 2 to 4', clicksOf(cases, names, 'multi')],
  ] as const) {
    tell(title, CLICKS, (make) => measureClicks(cases, grips, make));
  }
  console.log(`inverse kinematics, median\n${lines.join('\n')}`);
}, 300_000);
