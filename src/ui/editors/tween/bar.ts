/**
 * The bar under the scrubber for values between keys: of the pose at the current time, or of the selected keys. One
 * drag of the slider, a button or a typed number is one step; Escape gives up a drag, and closes the bar.
 */

import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { easeKeys, relaxKeys, SCALE_ABOUT, scaleKeys, tweenKeys } from '../../../edit/commands/keys.ts';
import { relaxPose, tweenPose } from '../../../edit/commands/pose.ts';
import { onEachCharacter } from '../../../edit/in-turn.ts';
import { countKeys } from '../../../edit/keys/selection.ts';
import { keysWithin } from '../../../edit/keys/tween.ts';
import { tweenedPose } from '../../../edit/pose/tween.ts';
import type { Document } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import { TWEEN_WAYS, type TweenKind, type TweenWay } from '../../state/tween-ways.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { leaveField } from '../../widgets/focus/focus.ts';
import { OFFERED } from '../../widgets/focus/typing.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { autoKey, meantOfEach } from '../posing/pose-edits.ts';
import { editOfTakes, onAllInHand, selectedKeysInView } from '../timeline/current-take.ts';
import { timelineTake } from '../timeline/timeline-take.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;
/** Previews a value within a gesture. */
type Preview = (edit: HandEdit, value: number) => void;

const ways: readonly TweenWay[] = TWEEN_WAYS;
const ABOUT_LABELS = { first: 'first key', last: 'last key', mean: 'mean', pose: 'file pose' } as const;
const STEP = 0.01;

/** Stays for as long as the page, hidden while no way is chosen. @param row the ruler's, after which it is put */
export function tweenBar(wb: Parts, row: HTMLElement): HTMLElement {
  return new TweenBar(wb, row).element;
}

class TweenBar {
  readonly element: HTMLElement;
  private readonly name = element('b');
  private readonly slider = element('input', {
    type: 'range',
    step: String(STEP),
    class: 'tween-slider',
    'aria-label': 'Share',
  });
  private readonly presets = element('span', { class: 'tools' });
  private readonly about = element('select', { 'aria-label': 'Scale about' });
  private readonly what = element('span', { class: 'faint tween-what' });
  private readonly field: NumberField;
  private readonly show: () => void;
  /** The gesture under way. */
  private edit: HandEdit | undefined;

  constructor(
    private readonly wb: Parts,
    row: HTMLElement,
  ) {
    const { timeline, messages } = wb;
    for (const each of SCALE_ABOUT) this.about.append(element('option', { value: each }, ABOUT_LABELS[each]));
    this.field = new NumberField({
      label: 'Share',
      text: (value) => shown(value, 3),
      step: 0.1,
      commit: (value) => this.apply(value),
      refuse: (reason) => messages.note(reason, 'warning'),
    });
    setAttribute(this.field.element, OFFERED, '');
    const close = button('Close', { class: 'tool' }, icon('close'), () => this.close());
    const { name, presets, slider, field, about, what } = this;
    this.element = element(
      'div',
      { class: 'tween-bar', role: 'group', 'aria-label': 'Between keys', hidden: true },
      name,
      presets,
      slider,
      field.element,
      about,
      what,
      close,
    );
    this.show = oncePerFrame(() => {
      const { way } = this;
      if (way) setText(what, targetText(wb, way));
    });
    this.listen();
    // The bar is in the page before a way is chosen: an element that isn't can't take the focus.
    row.after(this.element);
    timeline.tween.subscribe((kind) => this.choose(kind));
    for (const each of [timeline.view, wb.transport, wb.store]) each.subscribe(this.show);
    this.choose(timeline.tween.get());
  }

  private get way(): TweenWay | undefined {
    const chosen = this.wb.timeline.tween.get();
    return ways.find(({ kind }) => kind === chosen);
  }

  private listen(): void {
    const { slider } = this;
    slider.addEventListener('input', () => {
      this.field.show(Number(slider.value));
      this.preview(Number(slider.value));
    });
    slider.addEventListener('change', () => this.finish());
    this.element.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || this.edit) return;
      event.preventDefault();
      event.stopPropagation();
      this.close();
    });
  }

  private choose(kind: TweenKind | undefined): void {
    const { way, element: bar, slider } = this;
    const hadFocus = bar.contains(document.activeElement);
    write(bar, 'hidden', kind === undefined);
    if (!way) {
      if (hadFocus) leaveField(this.field.element);
      return;
    }
    setText(this.name, way.label);
    slider.min = String(way.span[0]);
    slider.max = String(way.span[1]);
    setTooltip(slider, way.text);
    this.presets.replaceChildren(...way.presets.map((value) => preset(value, () => this.apply(value))));
    write(this.about, 'hidden', kind !== 'scale');
    this.rest();
    this.show();
    this.field.element.focus();
  }

  /** A value as one step. */
  private apply(value: number): void {
    this.preview(value);
    this.finish();
  }

  private preview(value: number): void {
    const { wb, way } = this;
    this.edit ??= this.begin();
    if (way) previewOf(wb, way.kind, this.about.value)?.(this.edit, value);
  }

  private begin(): HandEdit {
    const { wb } = this;
    const current = timelineTake(wb);
    pausePlayback(wb);
    return current && ofKeys(wb, this.way) ? editOfTakes(wb, current.parts) : new HandEdit(wb.store, wb.messages);
  }

  private finish(): void {
    this.edit?.commit();
    this.edit = undefined;
    this.rest();
    this.show();
  }

  private rest(): void {
    const { neutral = 0 } = this.way ?? {};
    this.slider.value = String(neutral);
    this.field.show(neutral);
  }

  private close(): void {
    this.wb.timeline.tween.update(() => undefined);
  }
}

function preset(value: number, apply: () => void): HTMLElement {
  return button(shown(value), { class: 'tool text-tool' }, shown(value), apply);
}

/** Whether it is for the selected keys now. */
function ofKeys(wb: Parts, way: TweenWay | undefined): boolean {
  return way !== undefined && way.of !== 'pose' && (way.of === 'keys' || selectedKeysInView(wb).length > 0);
}

function previewOf(wb: Parts, kind: TweenKind, about: string): Preview | undefined {
  const way = ways.find((each) => each.kind === kind);
  if (ofKeys(wb, way)) {
    const keys = selectedKeysInView(wb);
    const characterId = timelineTake(wb)?.character.id;
    if (!keys.length || characterId === undefined) return undefined;
    const apply =
      <A>(command: Command<A, Document | Change>, args: (value: number) => A): Preview =>
      (edit, value) =>
        edit.preview(command, args(value));
    const of = { characterId, keys };
    if (kind === 'tween') return apply(onAllInHand(wb, tweenKeys), (u) => ({ ...of, u }));
    if (kind === 'relax') return apply(onAllInHand(wb, relaxKeys), (amount) => ({ ...of, amount }));
    if (kind === 'ease') return apply(onAllInHand(wb, easeKeys), (amount) => ({ ...of, amount }));
    const from = SCALE_ABOUT.find((each) => each === about) ?? 'first';
    return apply(onAllInHand(wb, scaleKeys), (valueFactor) => ({ ...of, valueFactor, about: from }));
  }
  const key = autoKey(wb);
  const { timeSeconds } = wb.transport.get();
  const each = meantOfEach(wb).map(({ character, dofs }) => ({
    ...{ characterId: character.id, timeSeconds },
    ...(dofs && { dofs }),
    ...(key && { key }),
  }));
  if (each.length === 0) return undefined;
  const label = (verb: string) => `${verb} ${each.length} characters`;
  if (kind === 'relax') {
    const command = onEachCharacter(relaxPose, label('Relax'));
    return (edit, amount) =>
      edit.preview(
        command,
        each.map((of) => ({ ...of, amount })),
      );
  }
  const toward = kind === 'rest' ? 'rest' : 'keys';
  const command = onEachCharacter(tweenPose, label('Tween'));
  return (edit, u) =>
    edit.preview(
      command,
      each.map((of) => ({ ...of, u, toward }) as const),
    );
}

/** What it applies to, and what is left alone. */
function targetText(wb: Parts, way: TweenWay): string {
  if (ofKeys(wb, way)) {
    const channels = timelineTake(wb)?.take.channels ?? [];
    const keys = selectedKeysInView(wb);
    const count = countKeys(channels, keys);
    if (count === 0) return 'Select keys first.';
    const changed = way.kind === 'scale' ? count : countKeys(channels, keysWithin(channels, keys));
    if (changed === 0) return 'No selected key lies between keys that are not selected.';
    const alone = count - changed;
    return `${plural(changed, 'selected key')}${alone > 0 ? `; ${alone} without keys on both sides left alone` : ''}`;
  }
  const each = meantOfEach(wb);
  if (each.length === 0) return '';
  let [count, leftAlone, locked] = [0, 0, 0];
  for (const { character, dofs } of each) {
    const tweened = tweenedPose(character, wb.transport.get().timeSeconds, { kind: 'keys', u: 0 }, dofs);
    const locks = lockedDofs(character);
    count += tweened.values.size;
    leftAlone += tweened.leftAlone;
    locked += [...tweened.values.keys()].filter((dof) => locks.has(dof)).length;
  }
  if (count === 0) return 'No DOF here has a key on both sides.';
  const of = each.length > 1 ? ` of ${each.length} characters` : '';
  const alone = leftAlone > 0 ? `; ${leftAlone} without keys on both sides left alone` : '';
  return `${plural(count - locked, 'DOF')}${of}${alone}${locked > 0 ? `; ${locked} locked` : ''}`;
}
