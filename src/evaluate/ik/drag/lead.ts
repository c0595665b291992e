/**
 * The pose for a position of the hand. It depends on that position and on the pose at the start of the drag only, not
 * on the hand's path: the point is led from the start along a straight line in steps, and where it can be reached, the
 * pose that satisfies hand and pins and is nearest to the start is taken (`Homing`). So the hand's way back restores
 * the pose, and a hand that is still has nothing left to wait for.
 */
import { type HandProblem, IS_THERE, TURN_WAY } from './hand-problem.ts';
import { Homing } from './homing.ts';
import { Shaking } from './shaking.ts';

/** Fraction of the reach. Poses between steps must not flip; shorter ones find few others and cost more. */
const STEP = 0.1;
/** Longer lines have longer steps. */
const MAX_STEPS = 24;
/** The step is longer by this factor where the hand is out of reach, and the pose changes slowly. */
const STRIDE = 2;
/** Solves at the end of the line for a hand out of reach, and the progress that is worth another. */
const MAX_ROUNDS = 4;
const PROGRESS = 1e-6;
/** Iterations for homing on the way, at the end, and for shaking. */
const HOMING_ON_WAY = 100;
const HOMING = 240;
const SHAKING = 96;

/** Finds the pose for each position of the hand in one drag, independent of the hand's path. */
export class Lead {
  private readonly startPose: Float64Array;
  private readonly from: Float64Array;
  private readonly homing: Homing;
  private readonly shaking: Shaking;

  /** The drag starts at the current pose. */
  constructor(private readonly of: HandProblem) {
    this.startPose = of.dofs.slice();
    this.from = of.hand.slice();
    this.homing = new Homing(of);
    this.shaking = new Shaking(of);
  }

  /** Writes the pose to the problem's `dofs`. @param angle that the hand has turned by */
  to(x: number, y: number, z: number, angle: number): void {
    const { of, from, homing, shaking } = this;
    const { reach } = of;
    of.dofs.set(this.startPose);
    of.moveHand(from[0], from[1], from[2]);
    of.turnHand(0);
    of.forget();
    of.look();
    const way = Math.hypot(x - from[0], y - from[1], z - from[2]) + TURN_WAY * reach * Math.abs(angle);
    const step = Math.max(STEP * reach, way / MAX_STEPS);
    let isOut = false;
    let isShaken = false;
    for (let gone = step; gone < way * (1 - 1e-9); gone += isOut ? STRIDE * step : step) {
      const part = gone / way;
      of.moveHand(from[0] + part * (x - from[0]), from[1] + part * (y - from[1]), from[2] + part * (z - from[2]));
      of.turnHand(part * angle);
      of.solve('drag');
      // Once: what did not help a step ago will not help now.
      if (!isShaken && shaking.isDue) this.shake();
      isShaken = shaking.isDue;
      isOut = of.missing > IS_THERE * reach;
      if (!isOut) homing.come(HOMING_ON_WAY);
    }
    of.moveHand(x, y, z);
    of.turnHand(angle);
    of.solve('drag');
    if (shaking.isDue) this.shake();
    this.solveExactly();
    if (of.missing > IS_THERE * reach) return;
    homing.come(HOMING);
    of.solve('exact');
  }

  private shake(): void {
    this.of.left = SHAKING;
    this.shaking.shake();
  }

  private solveExactly(): void {
    const { of } = this;
    for (let round = 0; round < MAX_ROUNDS; round++) {
      const before = of.missing;
      of.solve('rest');
      if (of.missing <= IS_THERE * of.reach || before - of.missing < PROGRESS * of.reach) return;
    }
  }
}
