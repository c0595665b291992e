/**
 * The handles of the selected pin: arrows move it along an axis, squares in a plane, and rings turn what it holds.
 * While they are there, the selected joint has none of its own.
 */
import { axisOf, type HandleId, type JointHandles } from '../../../evaluate/handles/joint-handles.ts';
import { type PinAxes, pinAxes, pinHandles } from '../../../evaluate/handles/pin-handles.ts';
import type { Character } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { lengthStep } from '../../../model/skeleton/reach.ts';
import { type GizmoSource, JointGizmo } from '../../../view/gizmo/joint-gizmo.ts';
import { dofValueText } from '../../state/joints/dof-text.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import type { Workbench } from '../../state/workbench.ts';
import { aligned } from '../../widgets/numbers/number-text.ts';
import { GizmoChip } from '../fk/gizmo-chip.ts';
import { KnownHandles } from '../fk/known-handles.ts';
import { FINGER } from '../fk/selected-gizmo.ts';
import { SNAP_ANGLE } from '../posing/active-dof.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { HandPull } from './hand-pull.ts';
import { type PinMove, pinWay } from './pin-way.ts';
import { inWorld, pinUnder, type SeenSkeleton, seenSkeletons } from './pins-on-screen.ts';
import type { PointHand } from './point-hand.ts';
import { selectedPin } from './selected-pin.ts';

const NAMES = ['x', 'y', 'z'] as const;

interface Known {
  /** The joint's handles, of which there are others when anything of the pose has changed. */
  readonly from: JointHandles;
  readonly pin: Pin;
  readonly axes: PinAxes;
  readonly handles: JointHandles;
}

export class PinGizmo {
  private gizmo: JointGizmo | undefined;
  private chip: GizmoChip | undefined;
  private readonly joints = new KnownHandles();
  private known: Known | undefined;
  private hovered: HandleId | undefined;
  private dragged: HandleId | undefined;
  private stops: (() => void)[] = [];

  constructor(
    private readonly wb: Workbench,
    private readonly hand: PointHand,
  ) {}

  enter(): void {
    const { wb } = this;
    this.chip = new GizmoChip(wb.viewportElement);
    const source: GizmoSource = {
      handles: () => this.handles(),
      state: () => ({
        active: undefined,
        hovered: this.hovered,
        dragged: this.dragged && { id: this.dragged, from: 0, stop: undefined },
      }),
      scale: () => wb.settings.get().gizmoScale,
      drawn: (layout, width, height) => this.chip?.place(layout, this.chipText(), width, height),
    };
    this.gizmo = new JointGizmo(wb.viewportElement, source, 'pin-gizmo');
    this.stops = [wb.viewport.addOverlay(this.gizmo), wb.posing.ik.axes.subscribe(() => wb.viewport.requestRender())];
  }

  leave(): void {
    for (const stop of this.stops) stop();
    this.stops = [];
    this.chip?.remove();
    this.gizmo = this.chip = this.hovered = this.dragged = undefined;
  }

  /** Lights up the handle under the pointer. Whether there is one: pins themselves come first. */
  hover(at: CanvasPointer | undefined): boolean {
    const id = at && this.under(at);
    if (id) this.chip?.show(meaning(id));
    else if (!this.dragged) this.chip?.hide();
    if (id !== this.hovered) this.wb.viewport.requestRender();
    this.hovered = id;
    return id !== undefined;
  }

  /** The drag of the handle under the pointer, if there is one. */
  press(at: CanvasPointer): CanvasDrag | undefined {
    const { wb } = this;
    const id = at.button === 0 ? this.under(at) : undefined;
    const found = selectedPin(wb);
    const { known } = this;
    if (!id || !found || !known) return undefined;
    const { character, pin } = found;
    const placement = wb.viewport.pickedCopy(character);
    const grip = { characterId: character.id, placement, joint: pin.joint, point: pin.point, pin: pin.id };
    wb.viewport.canvas.style.cursor = 'grabbing';
    return this.hand.begin(grip, at, () => {}, {
      begin: (hand) => this.steer(id, known.handles, character, hand, at),
      over: () => {
        this.dragged = undefined;
        this.chip?.hide();
      },
    });
  }

  private steer(id: HandleId, handles: JointHandles, character: Character, hand: HandPull, at: CanvasPointer) {
    const { viewport, settings } = this.wb;
    const { skeleton } = character;
    const radius = this.gizmo?.radiusOf(handles) ?? 1;
    const perWorld = this.perWorld(character);
    const snaps = { length: (skeleton ? lengthStep(skeleton) : 1) / perWorld, angle: SNAP_ANGLE };
    const size = radius * viewport.eye.unitsPerPixel(handles.pivot);
    const way = pinWay(id, handles, hand, { sight: viewport.eye, at, size, snaps });
    this.dragged = id;
    return (now: CanvasPointer) => {
      const moves = way?.(now) ?? [];
      const isTurn = id.kind === 'own';
      const text = ({ axis, by }: PinMove) =>
        isTurn
          ? dofValueText({ name: NAMES[axis], unit: 'angle' }, by, character, settings.get().angles)
          : `${NAMES[axis]} ${signed(by * perWorld)}`;
      const unit = isTurn ? '' : ` ${lengthUnit(character)}`;
      this.chip?.show(`${moves.map(text).join('  ')}${unit}`);
    };
  }

  /** Of the character's unit, what a length of 1 in the world is. */
  private perWorld({ id, ...character }: Character): number {
    const { viewport } = this.wb;
    const to = viewport.placementOf(id, viewport.pickedCopy({ id, ...character }));
    const size = to ? Math.hypot(to[0], to[1], to[2]) : 1;
    return size > 0 ? 1 / size : 1;
  }

  private under(at: CanvasPointer): HandleId | undefined {
    if (at.altKey || !selectedPin(this.wb)) return undefined;
    const hit = this.gizmo?.at(at.clientX, at.clientY, at.pointerType === 'touch' ? FINGER : 0);
    return hit && !pinUnder(this.wb, at) ? hit.id : undefined;
  }

  private chipText() {
    const found = selectedPin(this.wb);
    if (!found) return undefined;
    return { name: jointName(found.character.skeleton, found.pin.joint), value: 'pin', limits: '' };
  }

  /** As the viewport shows the pin; the same object as long as nothing has changed. */
  private handles(): JointHandles | undefined {
    const { wb } = this;
    const found = selectedPin(wb);
    const seen = found && this.seen(found.character);
    if (!found || !seen) return undefined;
    const { pin, character } = found;
    const { skeleton, dofs, world, toWorld } = seen;
    const from = this.joints.of(skeleton, pin.joint, dofs, world, toWorld, character.clampsToLimits);
    const axes = wb.posing.ik.axes.get();
    const { known } = this;
    if (known && known.from === from && known.pin === pin && known.axes === axes) return known.handles;
    const { parent } = skeleton.joints[pin.joint];
    const along = pinAxes(axes, pin.joint, parent, world);
    const pivot = inWorld(seen, pin.joint, pin.point);
    const handles = pinHandles(pivot, from.size, along, toWorld, pin.holdsOrientation);
    this.known = { from, pin, axes, handles };
    return handles;
  }

  private seen(character: Character): SeenSkeleton | undefined {
    const placement = this.wb.viewport.pickedCopy(character);
    for (const one of seenSkeletons(this.wb, ({ id }) => id === character.id))
      if (one.placement === placement) return one;
    return undefined;
  }
}

function meaning(id: HandleId): string {
  const axis = axisOf(id);
  if (axis === undefined) return '';
  const others = NAMES.filter((_, k) => k !== axis);
  if (id.kind === 'across') return `along ${others.join(' and ')}`;
  return `${id.kind === 'own' ? 'about' : 'along'} ${NAMES[axis]}`;
}

/** `+0.230`. */
function signed(value: number): string {
  const text = aligned(Math.abs(value));
  return `${Number(text) === 0 ? '' : value > 0 ? '+' : '−'}${text}`;
}
