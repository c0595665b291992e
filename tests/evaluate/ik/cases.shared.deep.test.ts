/** The reference cases: targets that can be reached, targets that can't, and drags. */
import { expect, it } from 'vitest';
import { ikProblem, movePin } from '../../../src/evaluate/ik/problem.ts';
import { solve } from '../../../src/evaluate/ik/solve.ts';
import type { IkProblem } from '../../../src/evaluate/ik/state.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { caseSkeleton, type IkDrag, ikCases, type Target, tipPin } from '../../helpers/ik-cases.ts';
import { describeShared } from '../../helpers/shared.ts';

/** Of all cases that can be solved. */
const SOLVED_AT_LEAST = 0.995;

describeShared('inverse kinematics, against the reference', () => {
  const cases = ikCases();
  const within = (name: string) => cases.tolerance * cases.skeletons[name].reach;

  function settled(name: string, targets: readonly Target[]): IkProblem {
    const skeleton = caseSkeleton(cases, name);
    const pose = Float64Array.from(filePose(skeleton, 0));
    const problem = ikProblem(
      skeleton,
      targets.map((target) => tipPin(skeleton, target)),
      pose,
    );
    solve(problem, pose, 'settle');
    return problem;
  }

  it('solves what can be reached, with one target and with several', () => {
    const unsolved: string[] = [];
    let count = 0;
    const attempt = (name: string, targets: readonly Target[]) => {
      count++;
      const { residuals } = settled(name, targets).result;
      if (!residuals.every((off) => off <= within(name))) unsolved.push(`${name} ${JSON.stringify(targets)}`);
    };
    for (const [name, list] of Object.entries(cases.single)) for (const target of list) attempt(name, [target]);
    for (const [name, list] of Object.entries(cases.multi)) for (const targets of list) attempt(name, targets);
    expect(count).toBeGreaterThan(1000);
    expect(unsolved.length, unsolved.join('\n')).toBeLessThanOrEqual((1 - SOLVED_AT_LEAST) * count);
  });

  it.each(Object.entries(cases.unreachable))(
    'inverse kinematics, against the reference comes as near as can be to what %s can not reach',
    (name, list) => {
      for (const [joint, x, y, z, least] of list) {
        const { residuals, isSolved } = settled(name, [[joint, x, y, z]]).result;
        expect(residuals[0]).toBeLessThan(least + within(name));
        expect(isSolved).toBe(false);
      }
    },
  );

  it.each(cases.drags.map((drag, i) => ({ drag, title: `${i}, ${drag.kind}, of ${drag.skeleton}` })))(
    'follows drag $title',
    ({ drag }) => expect(stepsOff(drag)).toEqual([]),
  );

  /** The steps at which a pin is further off than it has to be. */
  function stepsOff({ skeleton: name, joint, pinned, path, optimum, start = [] }: IkDrag): number[] {
    const skeleton = caseSkeleton(cases, name);
    const pose = Float64Array.from(filePose(skeleton, 0));
    start.forEach((degrees, j) => {
      pose[3 + j] = (degrees * Math.PI) / 180;
    });
    const dragged = tipPin(skeleton, [joint, 0, 0, 0]);
    const problem = ikProblem(skeleton, [dragged, ...pinned.map((pin) => tipPin(skeleton, pin, true))], pose);
    const off: number[] = [];
    for (let step = 0; step < path.length / 3; step++) {
      movePin(problem, 0, path[3 * step], path[3 * step + 1], path[3 * step + 2]);
      const [own, ...held] = solve(problem, pose, 'drag').residuals;
      const least = optimum?.[step] ?? 0;
      if (!(own <= least + within(name) && held.every((distance) => distance <= within(name)))) off.push(step);
    }
    return off;
  }
});
