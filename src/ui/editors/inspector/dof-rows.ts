/** A slider for a DOF: its span, unit and limits, and whether keys or a change by hand determine it. */
import type { GUI } from 'lil-gui';
import { sameChange } from '../../../edit/pose/same-change.ts';
import { isDriven } from '../../../evaluate/pose.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { coupleOf, type DofCouple } from '../../../model/skeleton/couples.ts';
import type { CharacterDof, DofValue } from '../../../model/skeleton/dofs.ts';
import { reachOf } from '../../../model/skeleton/reach.ts';
import { isUnlimited, type Limit, type Skeleton, UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { shownPerUnit, typedUnits, unitText, withoutNoise } from '../../state/joints/angles.ts';
import { dofClass } from '../../state/joints/dof-class.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { BesideDofs } from '../../state/posing.ts';
import type { Settings } from '../../state/settings.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, setAttribute, write } from '../../widgets/dom.ts';
import { MAX_DECIMALS, shown } from '../../widgets/numbers/number-text.ts';
import { numberTyped, Slider, type SliderOptions, type Typed } from '../../widgets/numbers/slider.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { shownDofs } from '../posing/active-dof.ts';
import { autoKey, setOwn } from '../posing/pose-edits.ts';
import { channelName, namedChannel, spokenName } from '../timeline/channels.ts';
import { DifferMark } from './differ-mark.ts';
import { DofMark } from './dof-mark.ts';
import { openDofMenu } from './dof-menu.ts';
import type { LiveRows } from './live-rows.ts';

export interface DofRowContext {
  readonly wb: Workbench;
  readonly edit: HandEdit;
  readonly live: LiveRows;
}

/** What a row is for, besides its DOF. */
export interface DofRowOptions {
  /** Before the DOF's name in lists of several joints. */
  readonly prefix?: string;
  /** The same DOF of other selected joints: a drag changes all by the same amount, what is typed sets all. */
  readonly matching?: readonly number[];
}

export function addDofRow(
  { wb, edit, live }: DofRowContext,
  section: GUI,
  character: Character,
  index: number,
  dof: CharacterDof,
  { prefix, matching = [] }: DofRowOptions = {},
): Slider {
  const { angles } = wb.settings.get();
  const factor = shownPerUnit(dof.unit, angles);
  const together = [index, ...matching];
  const isForSeveral = matching.length > 0;
  const named = spokenName(namedChannel(character, index));
  const spoken = isForSeveral ? `${dof.name} of ${together.length} joints` : named;
  const refuse = (reason: string) => {
    // After Escape, the typed text is discarded without a message.
    if (!edit.cancelled) wb.messages.note(reason, 'warning');
  };
  const slider = new Slider(section, spoken, 0, { ...sliderOptions(dof, character, angles), isForSeveral }, refuse);
  const { id } = character;
  const mark = new DofMark(wb, slider.domElement, id, together, spoken);
  const name = element('span', { class: `dof-name ${axisClass(dof, character)}` }, shortName(dof, character));
  const names = [...(prefix ? [element('span', { class: 'dof-joint' }, prefix)] : []), name];
  const differ = new DifferMark(slider, dof, angles);
  const unit = { angle: angles, length: lengthUnit(character), factor: '', weight: '' }[dof.unit];
  const shownAs = [mark.element, ...names, ...(isForSeveral ? [differ.element] : [])];
  slider.showName(unit ? `${spoken}, ${unit}` : spoken, ...shownAs);
  const title = `${prefix ? `${prefix} ` : ''}${dof.name}`;
  const couple = coupleOf(character.skeleton, index);
  const held = couple ? coupleText(couple, dof, character, angles) : limitText(dof, character, angles);
  setTooltip(slider.nameElement, `${title}: ${held}`);
  if (couple) disable(slider, `${title}: ${held}`, held, channelName(namedChannel(character, couple.follows)));
  slider.domElement.classList.add('dof');
  write(slider.domElement.dataset, 'dof', String(index));

  const update = () => {
    const now = findCharacter(wb.store.document, id);
    if (!now) return;
    const dofs = wb.viewport.character(id)?.dofs ?? now.pose;
    slider.showValue(withoutNoise((dofs[index] ?? 0) * factor));
    mark.show(now);
    if (!couple) hold(slider, lockedDofs(now).has(index));
    if (isForSeveral) differ.show(dofs, together);
  };
  letChange({ wb, edit, live }, slider, { id, index, matching, factor }, update);
  slider.domElement.addEventListener('contextmenu', (event) => {
    // While a number is edited, keep the browser's menu with Paste.
    const byMouse = event.button === 2;
    if (byMouse && event.target === slider.field && document.activeElement === slider.field) return;
    event.preventDefault();
    openDofMenu(wb, slider, id, together, byMouse ? { x: event.clientX, y: event.clientY } : undefined);
  });
  live.add(slider.domElement, update);
  return slider;
}

interface ChangedDof {
  /** The character's. */
  readonly id: string;
  readonly index: number;
  readonly matching: readonly number[];
  /** Displayed units per unit of the DOF. */
  readonly factor: number;
}

function letChange(
  { wb, edit }: DofRowContext,
  slider: Slider,
  { id, index, matching, factor }: ChangedDof,
  update: () => void,
): void {
  const together = [index, ...matching];
  // From the first change to the release, while pins hold.
  let beside: BesideDofs | undefined;
  /** The pose when the first change was made. */
  let from: Float64Array | undefined;
  const takeBack = () => {
    edit.cancel();
    beside = from = undefined;
  };
  slider.onChange((value: number) => {
    const now = findCharacter(wb.store.document, id);
    // Playback would overwrite the value with the next frame.
    const key = autoKey(wb);
    if (now && (key || together.some((dof) => isDriven(now, dof)))) pausePlayback(wb);
    beside ??= wb.posing.beside?.(id, together);
    from ??= now && shownDofs(wb, now);
    const one = from ? storedAs(from, index, value, factor) : { index, value: value / factor };
    const { typed } = slider;
    const others = !from
      ? []
      : typed
        ? typedValues(typed, from, one, matching, factor, slider.object.options)
        : sameChange(from, one, matching);
    const own = [one, ...others];
    if (typed && own.every((each) => each.value === from?.[each.index])) {
      takeBack();
      return;
    }
    const { timeSeconds } = wb.transport.get();
    const dofs = beside?.at(own) ?? own;
    const args = { characterId: id, dofs, timeSeconds, key };
    const command = setOwn(wb, own);
    edit.preview(command, args, () => addKeyed(wb, command, args));
    beside?.shown();
    if (edit.cancelled) update();
  });
  slider.onTakenBack(takeBack);
  slider.onFinishChange(() => {
    edit.commit();
    beside = from = undefined;
    update();
  });
}

/** A linked DOF can't be changed, and names the one that it follows. */
/** A locked DOF shows its value, and its mark unlocks it. */
function hold(slider: Slider, isLocked: boolean): void {
  if (slider.domElement.classList.contains('locked') === isLocked) return;
  slider.domElement.classList.toggle('locked', isLocked);
  write(slider.field, 'disabled', isLocked);
  setAttribute(slider.field, 'aria-description', isLocked ? 'locked' : undefined);
}

function disable(slider: Slider, tooltip: string, description: string, followed: string): void {
  slider.disable();
  setTooltip(slider.domElement, tooltip);
  setAttribute(slider.field, 'aria-description', description);
  slider.field.before(element('span', { class: 'dof-follows', 'aria-hidden': 'true' }, `← ${followed}`));
}

/**
 * What is typed, for the other joints: a number sets all, `+=5` and `*2` change each from its own value.
 *
 * @param from the pose before the edit, in the DOFs' unit
 * @param own the row's DOF; steps by arrow keys before the text have changed all by the same amount
 * @param perUnit displayed units per unit of the DOFs
 * @param field of the row
 */
export function typedValues(
  typed: Typed,
  from: ArrayLike<number>,
  own: Pick<DofValue, 'index'>,
  matching: readonly number[],
  perUnit: number,
  field: Pick<SliderOptions, 'units' | 'decimals'>,
): DofValue[] {
  const stepped = typed.from - from[own.index] * perUnit;
  return matching.flatMap((index) => {
    const value = numberTyped(typed.text, from[index] * perUnit + stepped, field);
    return value === undefined ? [] : storedAs(from, index, value, perUnit);
  });
}

/** A displayed value as its DOF stores it: the very number that it had if it is displayed as before. */
function storedAs(from: ArrayLike<number>, index: number, value: number, perUnit: number): DofValue {
  const isSame = withoutNoise(from[index] * perUnit) === withoutNoise(value);
  return { index, value: isSame ? from[index] : value / perUnit };
}

/**
 * The slider spans the limits if there are any and they are enforced; otherwise it spans the full range and hatches
 * what is beyond the limits.
 */
export function sliderOptions(
  dof: CharacterDof,
  character: Pick<Character, 'skeleton' | 'clampsToLimits'>,
  angles: Settings['angles'],
): SliderOptions {
  const factor = shownPerUnit(dof.unit, angles);
  const full = fullSpan(dof, character.skeleton);
  const { limit } = dof;
  const suffix = unitText(dof.unit, angles).trim() === '°' ? '°' : '';
  const resolution = { units: typedUnits(dof.unit, angles), ...resolutionOf(dof, full, angles) };
  if (dof.unit === 'weight') return { span: [0, 1], step: 0.001, decimals: 3 };
  if (!dof.takesLimits || isUnlimited(limit) || limit.min > limit.max) {
    return { span: scale(full, factor), suffix, ...resolution };
  }
  const limits = scale([limit.min, limit.max], factor);
  if (character.clampsToLimits && limit.max > limit.min) {
    return { span: scale(withOpenEnds(limit, full), factor), ...held(limits), limits, suffix, ...resolution };
  }
  const [low, high] = withOpenEnds(limit, full);
  const wide = [Math.min(full[0], low), Math.max(full[1], high)] as const;
  const bounds = character.clampsToLimits ? held(limits) : {};
  return { span: scale(wide, factor), limits, suffix, ...bounds, ...resolution };
}

function held(limits: readonly [number, number]) {
  return { bounds: limits, remedy: 'Turn off Enforce limits in the Edit menu to go past it.' };
}

/** From limit to limit; an unlimited side extends as far as that of an unlimited slider. */
function withOpenEnds({ min, max }: Limit, [low, high]: readonly [number, number]): readonly [number, number] {
  return [min > UNLIMITED.min ? min : Math.min(low, max + low), max < UNLIMITED.max ? max : Math.max(high, min + high)];
}

/** Without limits: ±π, or ± the character's reach; scales up to 2, whether a point is there 0 or 1, other factors ±1. */
function fullSpan(dof: CharacterDof, skeleton: Skeleton | undefined): readonly [number, number] {
  if (dof.name === 'valid') return [0, 1];
  if (dof.unit === 'factor') return dof.name.startsWith('s') ? [0, 2] : [-1, 1];
  const size = dof.unit === 'length' ? reachOf(skeleton) : Math.PI;
  return [-size, size];
}

function resolutionOf(dof: CharacterDof, span: readonly [number, number], angles: Settings['angles']) {
  if (dof.unit === 'angle') return angles === 'degrees' ? { step: 0.1, decimals: 2 } : { step: 0.001, decimals: 3 };
  // About a thousandth of the span, as a power of ten.
  const power = Math.floor(Math.log10((span[1] - span[0]) / 1000));
  return { step: 10 ** power, decimals: Math.max(0, Math.min(MAX_DECIMALS, 1 - power)) };
}

function scale([low, high]: readonly [number, number], factor: number): readonly [number, number] {
  return [withoutNoise(low * factor), withoutNoise(high * factor)];
}

/** `limits −30° to 45°`, `limits from −30°`, `no limits`. */
export function limitText(dof: CharacterDof, character: Pick<Character, 'clampsToLimits'>, angles: Settings['angles']) {
  if (dof.unit === 'weight') return '0 to 1; type a value to go beyond';
  if (!dof.takesLimits || isUnlimited(dof.limit)) return 'no limits';
  const factor = shownPerUnit(dof.unit, angles);
  const unit = unitText(dof.unit, angles);
  const [low, high] = [dof.limit.min, dof.limit.max].map((value) => `${shown(value * factor)}${unit}`);
  let range = `${low} to ${high}`;
  if (dof.limit.min <= UNLIMITED.min) range = `up to ${high}`;
  else if (dof.limit.max >= UNLIMITED.max) range = `from ${low}`;
  if (dof.limit.min > dof.limit.max) return `limits ${range} are reversed and ignored`;
  return character.clampsToLimits ? `limits ${range}` : `limits ${range}, not enforced`;
}

/** `follows 0.5 · rx of elbow + 10°`: why a row is disabled. */
export function coupleText(
  { follows, gain, offset }: DofCouple,
  dof: CharacterDof,
  character: Character,
  angles: Settings['angles'],
): string {
  const { unit } = namedChannel(character, follows);
  const from = shownPerUnit(unit, angles);
  const to = shownPerUnit(dof.unit, angles);
  const factor = shown((gain / from) * to);
  const added = offset === 0 ? '' : ` + ${shown(offset * to)}${unitText(dof.unit, angles)}`;
  return `linked to ${factor} · ${spokenName(namedChannel(character, follows))}${added}`;
}

/** `walker_blink` of the walker is its `blink`; the whole name is in the tooltip. */
function shortName({ name, unit }: CharacterDof, character: Character): string {
  if (unit !== 'weight') return name;
  for (const owner of [character.name, shownSkin(character)?.name, character.skeleton?.name]) {
    if (owner && name.startsWith(owner) && /^[_ .-]./.test(name.slice(owner.length)))
      return name.slice(owner.length + 1);
  }
  return name;
}

/** A colour by the DOF's axis, the accent for other axes; weights have none. */
function axisClass(dof: CharacterDof, { skeleton }: Character): string {
  return dof.unit === 'weight' ? 'plain-name' : dofClass(skeleton, dof);
}
