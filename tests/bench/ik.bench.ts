/**
 * A step of a drag: ours beside closed-chain-ik and three.js's CCDIKSolver (`ik-peers.ts` says how each is set), on the
 * drags of the reference cases that can be followed all the way. To hold: ten times closed-chain-ik's median, about
 * 12 µs for the chain of 30 joints with one pin and 60 µs with several, and no step unsolved.
 *
 * What is printed at the end is of whole paths: each is gone along several times, of each of its steps the shortest
 * time counts, so that what else the machine does counts for none, and of these the median is told; the same of those
 * steps alone that both solve, since giving up takes no time; and how many steps left a pin further off than 1e-3 of
 * the reach. CCD goes round ten times, enough or not.
 * Behind that, clicks: from the pose of the file straight to where random angles put the pins, ours with restarts.
 *
 * All solvers run from one bundle, as code that ships does.
 */
import { afterAll, bench, describe } from 'vitest';
import { bundled } from '../helpers/bundled.ts';
import { caseSkeleton, type IkCases, type IkDrag, ikCases, type Target } from '../helpers/ik-cases.ts';
import { hasShared } from '../helpers/shared.ts';
import type { Dragger, Grip } from './ik-peers.ts';

const { ccd, closedChain, ours } = await bundled<typeof import('./ik-peers.ts')>('tests/bench/ik-peers.ts');

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

/** A task for every solver: from the file pose, a path for the first pin, or a single target. */
interface Task {
  readonly grip: Grip;
  readonly path: readonly number[];
}

interface Measured {
  /** Microseconds of each step, and whether it solved all pins. */
  readonly times: readonly number[];
  readonly solves: readonly boolean[];
}

const ROUNDS = 16;

/** Solvers alternate round by round, so that a slow phase of the machine affects all of them. */
function measure(tasks: readonly Task[], solvers: typeof SOLVERS, tolerance: number): Measured[] {
  const runs = solvers.map(([, make]) =>
    tasks.map(({ path }) => ({
      make,
      times: Array.from({ length: path.length / 3 }, () => Infinity),
      solves: Array.from({ length: path.length / 3 }, () => true),
    })),
  );
  for (let round = 1; round <= ROUNDS; round++) {
    for (const ofSolver of runs) {
      ofSolver.forEach((run, t) => {
        const { grip, path } = tasks[t];
        const dragger = run.make(grip);
        for (let step = 0; step < run.times.length; step++) {
          const [x, y, z] = path.slice(3 * step, 3 * step + 3);
          const begin = performance.now();
          dragger.step(x, y, z);
          run.times[step] = Math.min(run.times[step], 1000 * (performance.now() - begin));
          const isOff = grip.targets.some((_, pin) => !(dragger.off(pin) <= tolerance * grip.reach));
          run.solves[step] &&= !isOff;
        }
      });
    }
  }
  return runs.map((ofSolver) => ({
    times: ofSolver.flatMap(({ times }) => times),
    solves: ofSolver.flatMap(({ solves }) => solves),
  }));
}

function median(values: readonly number[]): number {
  return values.toSorted((p, q) => p - q)[values.length >> 1];
}

/** Ratio of their times, over all steps or those that both solve. */
function times(one: Measured, other: Measured, onlySolved = false): string {
  const counts = (_: unknown, step: number) => !onlySolved || (one.solves[step] && other.solves[step]);
  if (!one.times.some(counts)) return '  no ratio';
  const ratio = median(one.times.filter(counts)) / median(other.times.filter(counts));
  return `${ratio.toFixed(1).padStart(6)}×`;
}

const dragsOf = (all: IkCases, drags: readonly IkDrag[]): Task[] =>
  drags.map((drag) => ({ grip: gripOf(all, drag), path: drag.path }));

function clicksOf(all: IkCases, skeletons: readonly string[], list: 'single' | 'multi'): Task[] {
  return skeletons.flatMap((name) => {
    const skeleton = caseSkeleton(all, name);
    const { reach } = all.skeletons[name];
    return (all[list][name] ?? []).map((entry) => {
      // One target is four numbers, several are lists of four.
      const targets = list === 'single' ? [entry as Target] : (entry as readonly Target[]);
      return { grip: { skeleton, reach, targets }, path: targets[0].slice(1) };
    });
  });
}

afterAll(() => {
  if (!cases) return;
  const lines: string[] = [];
  const tell = (title: string, solvers: typeof SOLVERS, tasks: readonly Task[]) => {
    const measured = measure(tasks, solvers, cases.tolerance);
    measured.forEach((of, s) => {
      const unsolved = of.solves.filter((does) => !does).length;
      lines.push(
        `  ${title.padEnd(30)} ${solvers[s][0].padEnd(26)} ${median(of.times).toFixed(1).padStart(7)} µs` +
          `${times(of, measured[0])}, ${times(of, measured[0], true)} where both solve;` +
          ` ${unsolved} of ${of.times.length} unsolved`,
      );
    });
  };
  const names = Object.keys(cases.skeletons);
  tell('drag: 30 joints, one pin', SOLVERS, dragsOf(cases, ofChain(1)));
  tell('drag: 30 joints, 2 and 3 pins', SOLVERS, dragsOf(cases, [...ofChain(2), ...ofChain(3)]));
  const [free, pinned] = [followed.filter((d) => d.pinned.length === 0), followed.filter((d) => d.pinned.length > 0)];
  tell('drag: all skeletons, one pin', SOLVERS, dragsOf(cases, free));
  tell('drag: all skeletons, several', SOLVERS, dragsOf(cases, pinned));
  tell('click: 30 joints, one pin', CLICKS, clicksOf(cases, ['chain30'], 'single'));
  tell('click: 30 joints, 2 to 4 pins', CLICKS, clicksOf(cases, ['chain30'], 'multi'));
  tell('click: all skeletons, one pin', CLICKS, clicksOf(cases, names, 'single'));
  tell('click: all skeletons, 2 to 4', CLICKS, clicksOf(cases, names, 'multi'));
  console.log(`inverse kinematics, median\n${lines.join('\n')}`);
}, 300_000);
