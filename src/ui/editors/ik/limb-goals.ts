/**
 * The handles of limbs in IK: a square at the goal, which is dragged as any end of a limb, and a point at the pole, on
 * a line from the middle joint. Where a goal is out of reach, a line leads to it from the limb's end.
 */
import { transformPoint, ZERO } from '../../../math/vec3.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import type { GoalPlace } from '../../../model/limbs.ts';
import { layerCode } from '../../../model/takes/layer-code.ts';
import type { PinPainter } from '../../../view/pins/pin-overlay.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { IkGrip } from './hand-pull.ts';
import { nearestOnScreen } from './nearest-on-screen.ts';
import { inWorld, type SeenSkeleton, seenSkeletons } from './pins-on-screen.ts';
import { PoleDrag } from './pole-drag.ts';

/** CSS pixels: of the marks, and around them. */
const GOAL_SIZE = 14;
const POLE_SIZE = 10;
const NEAR = 9;
const NEAR_TOUCH = 18;

/** A goal in the picture. */
interface SeenGoal {
  readonly seen: SeenSkeleton;
  readonly place: GoalPlace;
}

const hasGoals = (character: Character) => shownTake(character)?.goals !== undefined && !character.driver;

function seenGoals(wb: Uses<'store' | 'viewport' | 'transport'>): SeenGoal[] {
  const { timeSeconds } = wb.transport.get();
  return [...seenSkeletons(wb, hasGoals)].flatMap((seen) =>
    layerCode(seen.character)
      .goalPlaces(seen.character, timeSeconds, seen.dofs)
      .map((place) => ({ seen, place })),
  );
}

/** Draws all of them. */
export function paintGoals(wb: Uses<'store' | 'viewport' | 'transport'>, painter: PinPainter): void {
  for (const { seen, place } of seenGoals(wb)) {
    const { limb, point, pole } = place;
    const [, middle] = limb.joints;
    const at = transformPoint(seen.toWorld, point);
    painter.line(inWorld(seen, limb.joints[limb.joints.length - 1], limb.tip), at, 'pin', 2, true);
    painter.mark(at, { shape: limb.orient ? 'square' : 'round', color: 'pin', size: GOAL_SIZE });
    if (!pole) continue;
    const toPole = transformPoint(seen.toWorld, pole);
    painter.line(inWorld(seen, middle, ZERO), toPole, 'pin', 1, true);
    painter.mark(toPole, { shape: 'dot', color: 'pin', size: POLE_SIZE });
  }
}

/** Whether a press would take a goal or a pole. */
export function isOnGoal(wb: Uses<'store' | 'viewport' | 'transport'>, at: CanvasPointer): boolean {
  return handleUnder(wb, at) !== undefined;
}

function handleUnder(wb: Uses<'store' | 'viewport' | 'transport'>, at: CanvasPointer) {
  if (at.shiftKey || at.altKey) return undefined;
  const handles = seenGoals(wb).flatMap((goal) => [
    { goal, isPole: false, point: goal.place.point },
    ...(goal.place.pole ? [{ goal, isPole: true, point: goal.place.pole }] : []),
  ]);
  const places = handles.map(({ goal, point }) => wb.viewport.eye.toScreen(transformPoint(goal.seen.toWorld, point)));
  const near = at.pointerType === 'touch' ? NEAR_TOUCH : NEAR;
  const found = nearestOnScreen(places, { x: at.clientX, y: at.clientY }, near);
  return found < 0 ? undefined : handles[found];
}

/**
 * The drag of a goal or a pole under the pointer, if there is one.
 * @param begin begins one of a point, whose click is given
 */
export function pressGoal(
  wb: Workbench,
  at: CanvasPointer,
  begin: (grip: IkGrip, click: () => void) => CanvasDrag,
): CanvasDrag | undefined {
  const found = at.button === 0 ? handleUnder(wb, at) : undefined;
  if (!found) return undefined;
  const { seen, place } = found.goal;
  const { joints, tip } = place.limb;
  const select = { characterId: seen.character.id, placement: seen.placement, joint: joints[joints.length - 1] };
  if (found.isPole) return new PoleDrag(wb, found.goal, at, () => wb.store.select(select));
  return begin({ ...select, point: tip }, () => wb.store.select(select));
}
