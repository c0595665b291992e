/**
 * What IK draws over the scene and writes beside its points, as of the current frame. Nothing is drawn without pins,
 * locked joints or a hovered point.
 */
import type { DragReach } from '../../../evaluate/ik/drag/drag-reach.ts';
import { ikOf, pinTarget, pointAt } from '../../../evaluate/ik/set-up.ts';
import { type Vec3, ZERO } from '../../../math/vec3.ts';
import { type Character, shownSkin } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { reachOf } from '../../../model/skeleton/reach.ts';
import type { PinColor, PinPainter } from '../../../view/pins/pin-overlay.ts';
import type { PinRef } from '../../state/ik-hand.ts';
import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { gapText } from './gap-text.ts';
import type { PullState } from './hand-pull.ts';
import type { Label } from './ik-labels.ts';
import type { Standing } from './pins-beside.ts';
import {
  hasPins,
  inWorld,
  naturalPoints,
  offeredPoints,
  type SeenPin,
  type SeenPoint,
  type SeenSkeleton,
  seenSkeletons,
} from './pins-on-screen.ts';
import { reachOfDrag } from './reach.ts';

/** CSS pixels. */
const PIN_SIZE = 12;
const DIMMED_SIZE = 9;
const AXIS_LENGTH = 16;
/** As a part of the reach. */
const LIMB = 0.13;
/** Shorter gaps get no line. */
const MIN_GAP = 1.5;
/** As a part of the reach: closer counts as reached. */
const IS_THERE = 1e-3;

/** Opacity of pins that don't hold. */
const DIMMED = 0.5;

/** What is hovered and dragged. */
export interface HandNow {
  readonly pull: PullState | undefined;
  readonly hoveredPin: SeenPin | undefined;
  readonly hoveredPoint: SeenPoint | undefined;
  /** Feet that hold while a handle moves the body. */
  readonly standing: Standing | undefined;
  /** Whether a click pins the hovered point. */
  readonly pins: boolean;
}

/** Draws everything. @returns labels to be shown */
export function paintPins(
  wb: Uses<'store' | 'viewport' | 'posing' | 'settings'>,
  painter: PinPainter,
  hand: HandNow,
): Label[] {
  const labels: Label[] = [];
  const { pull, hoveredPoint, standing } = hand;
  const isOf = ({ id, ik }: Character) =>
    (ik !== undefined && (ik.pins.length > 0 || ik.stiff.length > 0)) ||
    hoveredPoint?.characterId === id ||
    pull?.grip.characterId === id ||
    standing?.characterId === id;
  for (const seen of seenSkeletons(wb, isOf)) {
    const { character, placement } = seen;
    paintStiff(painter, seen);
    const isPulled = pull?.grip.characterId === character.id && pull.grip.placement === placement;
    const points = hoveredPoint?.characterId === character.id && hoveredPoint.placement === placement;
    if (hoveredPoint && points && !pull) labels.push(...paintPoints(wb, painter, seen, hoveredPoint, hand.pins));
    for (const pin of character.ik?.pins ?? []) labels.push(...paintPin(wb, painter, seen, pin, hand));
    if (standing?.characterId === character.id && standing.placement === placement)
      paintStanding(painter, seen, standing.feet);
    if (isPulled && pull) labels.push(...paintPull(wb, painter, seen, pull));
    else if (!pull) labels.push(...paintLeft(wb, painter, seen));
  }
  return labels;
}

/** Only the pins, dimmed, without labels: in FK they don't hold. */
export function paintDimmedPins(wb: Uses<'store' | 'viewport'>, painter: PinPainter): void {
  for (const seen of seenSkeletons(wb, hasPins)) {
    for (const { joint, point, holdsOrientation, weight } of ikOf(seen.character).pins) {
      painter.mark(inWorld(seen, joint, point), {
        shape: holdsOrientation ? 'square' : 'round',
        color: 'pin',
        size: DIMMED_SIZE,
        fill: Math.min(1, weight),
        opacity: DIMMED,
        cover: coverOf(seen),
      });
    }
  }
}

function paintPin(
  wb: Uses<'viewport' | 'posing'>,
  painter: PinPainter,
  seen: SeenSkeleton,
  pin: Pin,
  hand: HandNow,
): Label[] {
  const { character, placement } = seen;
  const at = inWorld(seen, pin.joint, pin.point);
  const { selected, pointedAt } = wb.posing.ik;
  const is = (ref: PinRef | undefined) => ref?.characterId === character.id && ref.pin === pin.id;
  const { pull, hoveredPin } = hand;
  const isPulled = pull?.grip.characterId === character.id && pull.grip.pin === pin.id;
  const isHovered =
    hoveredPin?.character.id === character.id && hoveredPin.placement === placement && hoveredPin.pin.id === pin.id;
  const isLit = isHovered || is(pointedAt.get());
  const color: PinColor = isPulled ? 'selected' : isLit ? 'hovered' : is(selected.get()) ? 'selected' : 'pin';
  if (pin.holdsOrientation) paintAxes(wb, painter, seen, pin.joint, at);
  const { weight } = pin;
  painter.mark(at, {
    shape: pin.holdsOrientation ? 'square' : 'round',
    color,
    ...(!isLit && !isPulled && { cover: coverOf(seen) }),
    // A heavier pin is slightly larger, a lighter one less filled.
    size: PIN_SIZE + (isLit || isPulled ? 2 : 0) + (weight > 1 ? Math.min(4, Math.log2(weight)) : 0),
    fill: Math.min(1, weight),
  });
  // The selected pin is named beside its handles.
  if (is(selected.get()) || (!isLit && !isPulled)) return [];
  const { x, y, depth } = wb.viewport.eye.toScreen(at);
  const text = pinText(character, pin);
  return depth > 0 ? [{ kind: 'name', text, x, y, of: pinKey(seen, pin.id), side: sideOf(wb, seen, x) }] : [];
}

/** Key shared by all labels of a pin. */
function pinKey({ character, placement }: SeenSkeleton, pin: number): string {
  return `${character.id} ${placement} ${pin}`;
}

/** Away from the centre of the character's joints. */
function sideOf(wb: Uses<'viewport'>, { skeleton, world, toWorld }: SeenSkeleton, x: number): 'left' | 'right' {
  const sum = [0, 0, 0];
  for (let j = 0; j < skeleton.joints.length; j++) for (let k = 0; k < 3; k++) sum[k] += world[16 * j + 12 + k];
  const [mx, my, mz] = sum.map((part) => part / skeleton.joints.length);
  return x < wb.viewport.eye.toScreen(pointAt(toWorld, 0, [mx, my, mz])).x ? 'left' : 'right';
}

/** `foot_l · tip, orientation, weight 2`. */
function pinText(character: Character, pin: Pin): string {
  const parts = [pointName(character, pin)];
  if (pin.holdsOrientation) parts.push('orientation');
  if (pin.weight !== 1) parts.push(`weight ${shown(pin.weight)}`);
  return `${jointName(character.skeleton, pin.joint)} · ${parts.join(', ')}`;
}

/** The pinned point of its joint: `origin`, `End Site`; else a point of the skin, or just a point. */
export function pointName(character: Character, { joint, point }: Pick<Pin, 'joint' | 'point'>): string {
  const { skeleton } = character;
  if (!skeleton) return 'point';
  const skin = shownSkin(character);
  const near = 1e-6 * reachOf(skeleton);
  const found = naturalPoints(skeleton, joint, skin).find(
    (natural) => Math.hypot(...natural.point.map((part, k) => part - point[k])) <= near,
  );
  return found?.name ?? (skin ? 'point of the skin' : 'point');
}

function paintAxes(
  wb: Uses<'viewport'>,
  painter: PinPainter,
  { world, toWorld }: SeenSkeleton,
  joint: number,
  at: Vec3,
): void {
  const length = AXIS_LENGTH * wb.viewport.eye.unitsPerPixel(at);
  (['axisX', 'axisY', 'axisZ'] as const).forEach((color, axis) => {
    const way = [0, 1, 2].map((r) =>
      [0, 1, 2].reduce((sum, k) => sum + toWorld[4 * k + r] * world[16 * joint + 4 * axis + k], 0),
    );
    const size = Math.hypot(...way);
    if (!(size > 0)) return;
    const scale = length / size;
    painter.line(at, [at[0] + scale * way[0], at[1] + scale * way[1], at[2] + scale * way[2]], color, 2, false);
  });
}

/** How far a surface may be in front of a joint without covering it: about a limb's thickness. */
function coverOf({ skeleton, toWorld }: SeenSkeleton): number {
  return LIMB * reachOf(skeleton) * Math.hypot(toWorld[0], toWorld[1], toWorld[2]);
}

/** Joints that are locked or stiff. */
function paintStiff(painter: PinPainter, seen: SeenSkeleton): void {
  for (const { joint, stiffness } of seen.character.ik?.stiff ?? []) {
    if (joint >= seen.skeleton.joints.length) continue;
    const shape = stiffness === undefined ? 'lock' : 'stiff';
    painter.mark(inWorld(seen, joint, ZERO), { shape, color: 'label', size: 13 });
  }
}

/** What a drag of the hovered joint would move; the points that could be pinned, and the one that a click would pin. */
function paintPoints(
  wb: Uses<'viewport' | 'settings' | 'posing'>,
  painter: PinPainter,
  seen: SeenSkeleton,
  hovered: SeenPoint,
  pins: boolean,
): Label[] {
  const { character, skeleton } = seen;
  const { joint, natural } = hovered;
  if (joint >= skeleton.joints.length) return [];
  const cover = coverOf(seen);
  paintReach(painter, seen, joint, reachOfDrag(wb, character, skeleton, seen.world, seen.toWorld, joint));
  if (!pins) {
    const at = inWorld(seen, joint, natural?.point ?? hovered.point);
    painter.mark(at, { shape: 'ring', color: 'hovered', size: PIN_SIZE });
    return [];
  }
  for (const { point } of offeredPoints(wb, character, skeleton, joint)) {
    painter.mark(inWorld(seen, joint, point), { shape: 'dot', color: 'pin', size: 5, opacity: 0.7, cover });
  }
  const meant = natural?.point ?? (hovered.vertex === undefined ? undefined : hovered.point);
  if (!meant) return [];
  const at = inWorld(seen, joint, meant);
  painter.mark(at, { shape: 'ring', color: 'hovered', size: PIN_SIZE });
  const { x, y } = wb.viewport.eye.toScreen(at);
  const of = natural?.name ?? 'point of the skin';
  const text = `${jointName(character.skeleton, joint)} · ${of}`;
  return [{ kind: 'name', text, x, y, of: 'point', side: sideOf(wb, seen, x) }];
}

/** What is dragged, and the targets that can't be reached. */
function paintPull(wb: Uses<'viewport'>, painter: PinPainter, seen: SeenSkeleton, pull: PullState): Label[] {
  const { grip, gaps, hindrance, standing } = pull;
  const { character, toWorld } = seen;
  paintStanding(painter, seen, standing);
  if (grip.pin === undefined)
    painter.mark(inWorld(seen, grip.joint, grip.point), { shape: 'round', color: 'selected', size: 10 });
  return gaps.flatMap(({ index, joint, from, to }) => {
    const text = gapText(character, joint, hindrance);
    return paintGap(wb, painter, seen, {
      pin: character.ik?.pins[index]?.id,
      from: pointAt(toWorld, 0, from),
      to: pointAt(toWorld, 0, to),
      text: `${jointName(character.skeleton, joint)}: ${text}`,
    });
  });
}

/** Feet that hold by themselves, as pins do. */
function paintStanding(painter: PinPainter, seen: SeenSkeleton, standing: readonly Pin[]): void {
  for (const { joint, point } of standing) {
    painter.mark(inWorld(seen, joint, point), { shape: 'square', color: 'pin', size: PIN_SIZE, cover: coverOf(seen) });
  }
}

/** What a drag from here would move: the bones between the joints that would bend, and the feet that would hold. */
function paintReach(painter: PinPainter, seen: SeenSkeleton, joint: number, { bending, standing }: DragReach): void {
  paintStanding(painter, seen, standing);
  if (bending === 'body') return;
  const joints = new Set(bending);
  for (let j = joint; joints.has(j); j = seen.skeleton.joints[j].parent) {
    const at = inWorld(seen, j, ZERO);
    painter.mark(at, { shape: 'dot', color: 'hovered', size: 6 });
    const { parent } = seen.skeleton.joints[j];
    if (joints.has(parent)) painter.line(inWorld(seen, parent, ZERO), at, 'hovered', 2, false);
  }
}

/** Targets that an earlier drag could not reach. */
function paintLeft(wb: Uses<'viewport' | 'posing'>, painter: PinPainter, seen: SeenSkeleton): Label[] {
  const { character, skeleton, dofs, toWorld, world } = seen;
  const { targets } = wb.posing.ik;
  const left = targets.leftOf(character.id, dofs);
  if (!left) return [];
  const near = IS_THERE * reachOf(skeleton);
  return (character.ik?.pins ?? []).flatMap((pin) => {
    const target = targets.leftTarget(left, pin)?.position;
    if (!target) return [];
    const { position } = pinTarget(pin, world);
    if (Math.hypot(...position.map((p, k) => p - target[k])) <= near) return [];
    const text = `${jointName(character.skeleton, pin.joint)}: ${gapText(character, pin.joint, left.hindrance)}`;
    const [from, to] = [pointAt(toWorld, 0, position), pointAt(toWorld, 0, target)];
    return paintGap(wb, painter, seen, { pin: pin.id, from, to, text });
  });
}

/** Between a point and where it should be. */
interface Gap {
  /** Undefined for a point without a pin. */
  readonly pin: number | undefined;
  readonly from: Vec3;
  readonly to: Vec3;
  readonly text: string;
}

function paintGap(
  wb: Uses<'viewport'>,
  painter: PinPainter,
  seen: SeenSkeleton,
  { pin, from, to, text }: Gap,
): Label[] {
  const { eye } = wb.viewport;
  const a = eye.toScreen(from);
  const b = eye.toScreen(to);
  // A gap along the line of sight is short on screen, but still a gap.
  const inDepth = Math.hypot(...to.map((v, k) => v - from[k])) / eye.unitsPerPixel(from);
  if (Math.max(inDepth, Math.hypot(b.x - a.x, b.y - a.y)) < MIN_GAP) return [];
  painter.line(from, to, 'pinGap', 2, true);
  painter.mark(to, { shape: 'ring', color: 'pinGap', size: 10 });
  const of = pin === undefined ? 'dragged' : pinKey(seen, pin);
  return b.depth > 0 ? [{ kind: 'gap', text, x: b.x, y: b.y, of, side: sideOf(wb, seen, b.x) }] : [];
}
