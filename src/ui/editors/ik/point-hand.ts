/**
 * The hand that drags points of characters, in IK and in Pose mode: what is under the pointer, the drag, and all that
 * is drawn and written about both. What a press or a click means belongs to the mode's tool.
 */
import { findCharacter } from '../../../model/document.ts';
import { PinOverlay } from '../../../view/pins/pin-overlay.ts';
import type { Workbench } from '../../state/workbench.ts';
import { Readout } from '../../widgets/numbers/readout.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';
import { depthText } from './depth-text.ts';
import type { IkGrip, PullState } from './hand-pull.ts';
import { IkLabels } from './ik-labels.ts';
import { paintGoals } from './limb-goals.ts';
import { PinDrag, type PinDragEvents, type Steering } from './pin-drag.ts';
import { selectPin } from './pin-edits.ts';
import { type HandNow, paintPins } from './pin-picture.ts';
import { besidePins, type Standing } from './pins-beside.ts';
import { pinsInPicture, type SeenPin, type SeenPoint } from './pins-on-screen.ts';
import { deselectLostPin } from './selected-pin.ts';

/** With more triangles than this, hover picking would be slow: points are then highlighted on press only. */
const HOVER_TRIANGLES = 300_000;

export interface PointHandOptions {
  /** The point that a press would drag. Takes a picking render, so it is called once a frame at most. */
  readonly pointAt: (at: CanvasPointer) => SeenPoint | undefined;
  /** Whether a click pins a point: then the points to be pinned are drawn, and named. */
  readonly pins: boolean;
  /** What a drag of a joint would move, in words; undefined if none begins there. */
  readonly whatMoves: (characterId: string, joint: number) => string | undefined;
  /** What else moves points, such as arrow keys. */
  readonly pull?: () => PullState | undefined;
}

export class PointHand {
  private drag: PinDrag | undefined;
  private hoveredPin: SeenPin | undefined;
  private hoveredPoint: SeenPoint | undefined;
  /** Pointer position to be looked up in the next frame. */
  private looking: CanvasPointer | undefined;
  private frame = 0;
  private standing: Standing | undefined;
  private readonly labels: IkLabels;
  private readout: Readout | undefined;
  private stops: (() => void)[] = [];

  constructor(
    private readonly wb: Workbench,
    private readonly options: PointHandOptions,
  ) {
    this.labels = new IkLabels(wb);
  }

  enter(): void {
    const { wb, labels } = this;
    const overlay = new PinOverlay((painter) => {
      paintGoals(wb, painter);
      const shown = paintPins(wb, painter, this.now);
      labels.show(shown, shown.length ? pinsInPicture(wb).places : []);
    });
    const { selected, pointedAt, targets } = wb.posing.ik;
    const redraw = () => wb.viewport.requestRender();
    labels.enter();
    this.readout = new Readout(wb.viewportElement);
    wb.posing.beside = (id, dofs, joint) =>
      besidePins(wb, id, dofs, joint, (standing) => {
        this.standing = standing;
        redraw();
      });
    wb.posing.ik.whatMoves = this.options.whatMoves;
    // Another joint may have been selected in another mode.
    deselectLostPin(wb, true);
    this.stops = [
      wb.viewport.addOverlay(overlay),
      selected.subscribe(redraw),
      pointedAt.subscribe(redraw),
      wb.store.subscribe((now, before) => {
        const isAnother = now.selection !== before.selection;
        if (now.document.characters === before.document.characters && !isAnother) return;
        deselectLostPin(wb, isAnother);
        targets.keepOnly(new Set(now.document.characters.map(({ id }) => id)));
        this.forgetGone();
      }),
    ];
  }

  leave(): void {
    const { wb, labels } = this;
    this.show(undefined, undefined);
    for (const stop of this.stops) stop();
    this.stops = [];
    labels.leave();
    this.readout?.remove();
    this.readout = undefined;
    wb.posing.beside = this.standing = undefined;
    wb.posing.ik.whatMoves = undefined;
  }

  /** The point that is lit up. */
  get point(): SeenPoint | undefined {
    return this.hoveredPoint;
  }

  /** Lights up a pin or a point, or nothing. */
  show(pin: SeenPin | undefined, point: SeenPoint | undefined): void {
    this.looking = undefined;
    if (
      pin?.pin === this.hoveredPin?.pin &&
      pin?.placement === this.hoveredPin?.placement &&
      point === this.hoveredPoint
    )
      return;
    this.hoveredPin = pin;
    const { ik } = this.wb.posing;
    ik.isOverPin = pin !== undefined;
    ik.over = point;
    this.hoveredPoint = point;
    this.wb.viewport.requestRender();
  }

  /** Lights up the point that a press there would drag, in the next frame: finding it takes a render. */
  lookSoon(at: CanvasPointer): void {
    this.looking = at;
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const { looking, wb } = this;
      this.looking = undefined;
      const { style } = wb.viewport.canvas;
      // The pointer has come to a handle meanwhile.
      if (!looking || this.drag || style.cursor === 'grab') return;
      if (wb.viewport.stats().triangles > HOVER_TRIANGLES) return;
      this.show(undefined, this.options.pointAt(looking));
      style.cursor = this.hoveredPoint ? 'pointer' : '';
    });
  }

  /** @param click the press was one, without motion */
  begin(grip: IkGrip, at: CanvasPointer, click: () => void, steering?: Steering): PinDrag {
    this.show(undefined, undefined);
    const events: PinDragEvents = {
      click,
      longPress: () => {
        const { characterId, placement, joint, pin } = grip;
        if (pin === undefined) this.wb.store.select({ characterId, placement, joint });
        else selectPin(this.wb, { characterId, pin }, joint, placement);
      },
      over: () => {
        this.drag = undefined;
        this.readout?.hide();
        this.labels.say(this.labelOfGap());
        this.wb.viewport.canvas.style.cursor = '';
        this.wb.viewport.requestRender();
      },
      began: () => {
        this.wb.viewport.canvas.style.cursor = 'grabbing';
      },
      moved: (depth, now) => this.showDepth(grip.characterId, depth, now),
    };
    const drag = new PinDrag(this.wb, grip, at, events, steering);
    this.drag = drag;
    return drag;
  }

  /** Motion along the line of sight isn't visible: show it as a number. */
  private showDepth(characterId: string, depth: number | undefined, { clientX, clientY }: CanvasPointer): void {
    const character = findCharacter(this.wb.store.document, characterId);
    if (depth === undefined || !character) this.readout?.hide();
    else this.readout?.show(clientX, clientY, depthText(character, depth));
  }

  private forgetGone(): void {
    const { document } = this.wb.store;
    const { hoveredPin, hoveredPoint } = this;
    const isThere = (id: string | undefined) => findCharacter(document, id) !== undefined;
    const pins = hoveredPin && findCharacter(document, hoveredPin.character.id)?.ik?.pins;
    const keepsPin = hoveredPin && pins?.includes(hoveredPin.pin);
    this.show(keepsPin ? hoveredPin : undefined, isThere(hoveredPoint?.characterId) ? hoveredPoint : undefined);
  }

  private labelOfGap(): string {
    const labels: string[] = [];
    paintPins(this.wb, { mark() {}, line() {} }, this.now).forEach(({ kind, text }) => {
      if (kind === 'gap') labels.push(text);
    });
    return labels.join('. ');
  }

  private get now(): HandNow {
    const { hoveredPin, hoveredPoint, standing } = this;
    const pull = this.drag?.state ?? this.options.pull?.();
    return { pull, hoveredPin, hoveredPoint, standing, pins: this.options.pins };
  }
}
