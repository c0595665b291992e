/**
 * The bar under the scrubber for values between keys: of the pose at the current time, or of the selected keys. One drag
 * of the slider, a button or a typed number is one step; Escape gives up a drag, and closes the bar.
 */

import type { Edit } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { easeKeys, relaxKeys, SCALE_ABOUT, scaleKeys, tweenKeys } from '../../../edit/commands/keys.ts';
import { relaxPose, tweenPose } from '../../../edit/commands/pose.ts';
import { countKeys } from '../../../edit/keys/selection.ts';
import { keysWithin } from '../../../edit/keys/tween.ts';
import { tweenedPose } from '../../../edit/pose/tween.ts';
import type { Document } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
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
import { autoKey, dofsOfJoints } from '../posing/pose-edits.ts';
import { aboutKeysInHand, currentTake, editOfTake, selectedKeysInView } from '../timeline/current-take.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;
/** Previews a value within a gesture. */
type Preview = (edit: HandEdit, value: number) => void;

const ways: readonly TweenWay[] = TWEEN_WAYS;
const ABOUT_LABELS = { first: 'first key', last: 'last key', mean: 'mean', pose: 'file pose' } as const;
const STEP = 0.01;

/** Stays for as long as the page, hidden while no way is chosen. @param row the ruler's, after which it is put */
export function tweenBar(wb: Parts, row: HTMLElement): HTMLElement {
  const { timeline } = wb;
  let edit: HandEdit | undefined;
  const name = element('b');
  const slider = element('input', { type: 'range', step: String(STEP), class: 'tween-slider', 'aria-label': 'Share' });
  const presets = element('span', { class: 'tools' });
  const about = element('select', { 'aria-label': 'Scale about' });
  for (const each of SCALE_ABOUT) about.append(element('option', { value: each }, ABOUT_LABELS[each]));
  const what = element('span', { class: 'faint tween-what' });
  const field = new NumberField({
    label: 'Share',
    text: (value) => shown(value, 3),
    step: 0.1,
    commit: (value) => once(value),
    refuse: (reason) => wb.messages.note(reason, 'warning'),
  });
  setAttribute(field.element, OFFERED, '');
  const close = button('Close', { class: 'tool' }, icon('close'), () => timeline.tween.update(() => undefined));
  const bar = element(
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
  row.after(bar);

  const way = () => ways.find(({ kind }) => kind === timeline.tween.get());
  const rest = () => {
    const { neutral = 0 } = way() ?? {};
    slider.value = String(neutral);
    field.show(neutral);
  };
  const begin = () => {
    const current = currentTake(wb);
    pausePlayback(wb);
    return current && ofKeys(wb, way()) ? editOfTake(wb, current) : new HandEdit(wb.store, wb.messages);
  };
  const preview = (made: HandEdit, value: number) => {
    const kind = way()?.kind;
    if (kind) previewOf(wb, kind, about.value)?.(made, value);
  };
  const finish = () => {
    edit?.commit();
    edit = undefined;
    rest();
    show();
  };
  function once(value: number): void {
    edit ??= begin();
    preview(edit, value);
    finish();
  }
  slider.addEventListener('input', () => {
    edit ??= begin();
    const value = Number(slider.value);
    field.show(value);
    preview(edit, value);
  });
  slider.addEventListener('change', finish);
  bar.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || edit) return;
    event.preventDefault();
    event.stopPropagation();
    timeline.tween.update(() => undefined);
  });

  const show = oncePerFrame(() => {
    const now = way();
    if (now) setText(what, targetText(wb, now));
  });
  const choose = (kind: TweenKind | undefined) => {
    const now = way();
    const hadFocus = bar.contains(document.activeElement);
    write(bar, 'hidden', kind === undefined);
    if (!now) {
      if (hadFocus) leaveField(field.element);
      return;
    }
    setText(name, now.label);
    slider.min = String(now.span[0]);
    slider.max = String(now.span[1]);
    setTooltip(slider, now.text);
    presets.replaceChildren(...now.presets.map((value) => preset(value, once)));
    write(about, 'hidden', kind !== 'scale');
    rest();
    show();
    field.element.focus();
  };
  timeline.tween.subscribe(choose);
  timeline.view.subscribe(show);
  wb.transport.subscribe(show);
  wb.store.subscribe(show);
  choose(timeline.tween.get());
  return bar;
}

function preset(value: number, apply: (value: number) => void): HTMLElement {
  return button(shown(value), { class: 'tool text-tool' }, shown(value), () => apply(value));
}

/** Whether it is for the selected keys now. */
function ofKeys(wb: Parts, way: TweenWay | undefined): boolean {
  return way !== undefined && way.of !== 'pose' && (way.of === 'keys' || selectedKeysInView(wb).length > 0);
}

/** DOFs of the selected joints, else of the whole character. */
function scopeOf(wb: Parts) {
  const character = currentCharacter(wb);
  const joints = character ? selectedJointsOf(wb, character.id) : [];
  return { character, dofs: character && joints.length > 0 ? dofsOfJoints(character, joints) : undefined };
}

function previewOf(wb: Parts, kind: TweenKind, about: string): Preview | undefined {
  const way = ways.find((each) => each.kind === kind);
  if (ofKeys(wb, way)) {
    const keys = selectedKeysInView(wb);
    const characterId = currentTake(wb)?.character.id;
    if (!keys.length || characterId === undefined) return undefined;
    const apply =
      <A>(command: Command<A, Document | Edit>, args: (value: number) => A): Preview =>
      (edit, value) =>
        edit.preview(command, args(value));
    const of = { characterId, keys };
    if (kind === 'tween') return apply(aboutKeysInHand(wb, tweenKeys), (u) => ({ ...of, u }));
    if (kind === 'relax') return apply(aboutKeysInHand(wb, relaxKeys), (amount) => ({ ...of, amount }));
    if (kind === 'ease') return apply(aboutKeysInHand(wb, easeKeys), (amount) => ({ ...of, amount }));
    const from = SCALE_ABOUT.find((each) => each === about) ?? 'first';
    return apply(aboutKeysInHand(wb, scaleKeys), (valueFactor) => ({ ...of, valueFactor, about: from }));
  }
  const { character, dofs } = scopeOf(wb);
  if (!character) return undefined;
  const of = {
    characterId: character.id,
    timeSeconds: wb.transport.get().timeSeconds,
    ...(dofs && { dofs }),
    ...(autoKey(wb) && { key: autoKey(wb) }),
  };
  if (kind === 'relax') return (edit, amount) => edit.preview(relaxPose, { ...of, amount });
  const toward = kind === 'rest' ? 'rest' : 'keys';
  return (edit, u) => edit.preview(tweenPose, { ...of, u, toward });
}

/** What it applies to, and what is left alone. */
function targetText(wb: Parts, way: TweenWay): string {
  if (ofKeys(wb, way)) {
    const channels = currentTake(wb)?.take.channels ?? [];
    const keys = selectedKeysInView(wb);
    const count = countKeys(channels, keys);
    if (count === 0) return 'Select keys first.';
    const changed = way.kind === 'scale' ? count : countKeys(channels, keysWithin(channels, keys));
    if (changed === 0) return 'No selected key lies between keys that are not selected.';
    const alone = count - changed;
    return `${plural(changed, 'selected key')}${alone > 0 ? `; ${alone} without keys on both sides left alone` : ''}`;
  }
  const { character, dofs } = scopeOf(wb);
  if (!character) return '';
  const { values, leftAlone } = tweenedPose(character, wb.transport.get().timeSeconds, { kind: 'keys', u: 0 }, dofs);
  if (values.size === 0) return 'No DOF here has a key on both sides.';
  const alone = leftAlone > 0 ? `; ${leftAlone} without keys on both sides left alone` : '';
  return `${plural(values.size, 'DOF')}${alone}`;
}
