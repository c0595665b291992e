/**
 * Fields for the selected keys: time, value, slopes. Differing values show a dash, and typing sets all of them,
 * provided that all keys have the same unit.
 */
import { setKeys } from '../../../edit/commands/keys.ts';
import { countKeys } from '../../../edit/keys/selection.ts';
import { keySlope } from '../../../evaluate/slopes.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import type { DofUnit } from '../../../model/skeleton/skeleton.ts';
import { keysOf } from '../../../model/takes/take.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { shownPerUnit, typedUnits, withoutNoise } from '../../state/joints/angles.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { NumberField, type NumberFieldOptions } from '../../widgets/numbers/number-field.ts';
import { decimalsWithin, shown } from '../../widgets/numbers/number-text.ts';
import { type CurrentTake, onAllInHand, selectedKeysInView } from '../timeline/current-take.ts';
import { frameNumber } from '../timeline/snapping.ts';
import { namedIn, timelineTake } from '../timeline/timeline-take.ts';

/** Numbers shared by all selected keys; undefined if they differ. Seconds of the take, model units. */
export interface SharedNumbers {
  readonly time: number | undefined;
  readonly value: number | undefined;
  readonly slopeIn: number | undefined;
  readonly slopeOut: number | undefined;
}

/** Not computed for more keys than this: nobody types a time for all of them. */
const MAX_KEYS = 5000;
/** What fits into a field: `-418.731`. */
const MAX_CHARACTERS = 8;
const brief = (value: number) => shown(value, decimalsWithin(value, MAX_CHARACTERS));
const MIXED: SharedNumbers = { time: undefined, value: undefined, slopeIn: undefined, slopeOut: undefined };

function sharedNumbers({ take }: Pick<CurrentTake, 'take'>, keys: readonly ChannelKeys[]): SharedNumbers {
  if (!keys.length || countKeys(take.channels, keys) > MAX_KEYS) return MIXED;
  let found: { -readonly [K in keyof SharedNumbers]: SharedNumbers[K] } | undefined;
  for (const { channel: c, indices } of keys) {
    const channel = keysOf(take.channels[c]);
    for (const index of indices) {
      // A step counts once: what arrives at it, and the value that it goes on with.
      if (channel.times[index + 1] === channel.times[index]) continue;
      let arriving = index;
      while (channel.times[arriving - 1] === channel.times[index]) arriving--;
      const own = {
        time: channel.times[index],
        value: channel.values[index],
        slopeIn: keySlope(channel, arriving, 'in'),
        slopeOut: keySlope(channel, index, 'out'),
      };
      if (!found) found = own;
      if (found.time !== own.time) found.time = undefined;
      if (found.value !== own.value) found.value = undefined;
      if (found.slopeIn !== own.slopeIn) found.slopeIn = undefined;
      if (found.slopeOut !== own.slopeOut) found.slopeOut = undefined;
    }
  }
  return found ?? MIXED;
}

/** The keys without the earlier ones of steps: a value typed for both would remove the jump. */
function laterHalves({ take }: Pick<CurrentTake, 'take'>, keys: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return keys.map(({ channel, indices }) => {
    const { times } = keysOf(take.channels[channel]);
    return { channel, indices: indices.filter((k, i) => indices[i + 1] !== k + 1 || times[k + 1] !== times[k]) };
  });
}

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;

export function keyFields(wb: Parts): HTMLElement {
  return new KeyFields(wb).element;
}

class KeyFields {
  readonly element: HTMLElement;
  private readonly time: MixedField;
  private readonly value: MixedField;
  private readonly slopeIn: MixedField;
  private readonly slopeOut: MixedField;

  constructor(private readonly wb: Parts) {
    this.time = this.field(
      'Time of selected keys',
      (typed) => this.setTime(typed),
      () => ({}),
    );
    this.value = this.field('Value of selected keys', (typed) => this.set({ value: typed / this.perUnit() }));
    this.slopeIn = this.field('Incoming slope of selected keys, per second', (typed) =>
      this.set({ slopeIn: typed / this.perUnit() }),
    );
    this.slopeOut = this.field('Outgoing slope of selected keys, per second', (typed) =>
      this.set({ slopeOut: typed / this.perUnit() }),
    );
    const slopes = [labelled('Slope', this.slopeIn.element), this.slopeOut.element];
    this.element = element(
      'div',
      { class: 'key-fields', role: 'group', 'aria-label': 'Selected keys' },
      labelled('Time', this.time.element),
      labelled('Value', this.value.element),
      element('span', { class: 'slope-fields' }, ...slopes),
    );
    const show = oncePerFrame(() => this.show());
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) show();
    });
    wb.timeline.view.subscribe(show);
    wb.settings.subscribe(show);
    wb.transport.subscribe((now, before) => {
      if (now.framesPerSecond !== before.framesPerSecond) show();
    });
    show();
  }

  private field(label: string, commit: (value: number) => void, units = () => this.typedUnits()): MixedField {
    const refuse = (reason: string) => this.wb.messages.note(reason, 'warning');
    return new MixedField({ label, commit, text: brief, step: 1, units, refuse });
  }

  private typedUnits() {
    return typedUnits(this.unit(), this.wb.settings.get().angles);
  }

  private inFrames(): boolean {
    return this.wb.settings.get().timeDisplay === 'frames';
  }

  /** Undefined for keys of different units. */
  private unit(): DofUnit | undefined {
    const current = timelineTake(this.wb);
    if (!current) return undefined;
    const units = new Set(selectedKeysInView(this.wb).map((k) => namedIn(current, k.channel).unit));
    const [unit] = units;
    return units.size === 1 ? unit : undefined;
  }

  /** From model units to displayed ones. */
  private perUnit(): number {
    const unit = this.unit();
    return unit ? shownPerUnit(unit, this.wb.settings.get().angles) : 1;
  }

  private set(typed: Partial<Record<'timeSeconds' | 'value' | 'slopeIn' | 'slopeOut', number>>): void {
    const { wb } = this;
    const current = timelineTake(wb);
    const keys = selectedKeysInView(wb);
    if (!current || !keys.length) return;
    attempt(wb.messages, () => {
      const own = typed.value === undefined ? keys : laterHalves(current, keys);
      wb.store.apply(onAllInHand(wb, setKeys), { characterId: current.character.id, keys: own, ...typed });
    });
  }

  private setTime(typed: number): void {
    const { framesPerSecond } = this.wb.transport.get();
    const seconds = this.inFrames() ? typed / framesPerSecond : typed;
    this.set({ timeSeconds: seconds + (timelineTake(this.wb)?.character.timeOffsetSeconds ?? 0) });
  }

  private show(): void {
    const { wb, time, value, slopeIn, slopeOut } = this;
    const current = timelineTake(wb);
    const keys = selectedKeysInView(wb);
    const unit = this.unit();
    const all = [time, value, slopeIn, slopeOut];
    for (const one of all) one.enable(keys.length > 0);
    if (!current || !keys.length) {
      for (const one of all) one.show(undefined, '');
      return;
    }
    const numbers = sharedNumbers(current, keys);
    const per = this.perUnit();
    const { framesPerSecond } = wb.transport.get();
    const at = numbers.time === undefined ? undefined : numbers.time - current.character.timeOffsetSeconds;
    time.show(at === undefined ? undefined : this.inFrames() ? frameNumber(at, framesPerSecond) : withoutNoise(at));
    const scaled = (n: number | undefined) => (n === undefined || !unit ? undefined : withoutNoise(n * per));
    value.show(scaled(numbers.value));
    slopeIn.show(scaled(numbers.slopeIn));
    slopeOut.show(scaled(numbers.slopeOut));
    // One number can't be both radians and a length.
    for (const one of [value, slopeIn, slopeOut]) one.enable(unit !== undefined);
  }
}

/** A number field that may show several values. */
class MixedField {
  readonly element: HTMLInputElement;
  private readonly field: NumberField;

  constructor(options: NumberFieldOptions) {
    this.field = new NumberField(options);
    this.element = this.field.element;
  }

  /** @param otherwise shown if there is no single value */
  show(value: number | undefined, otherwise = '—'): void {
    write(this.element, 'placeholder', value === undefined ? otherwise : '');
    this.field.show(value ?? Number.NaN);
  }

  enable(enabled: boolean): void {
    write(this.element, 'disabled', !enabled);
  }
}

function labelled(label: string, field: HTMLElement): HTMLElement {
  return element(
    'label',
    { class: 'field' },
    element('span', { class: 'faint', 'data-short': label[0].toLowerCase() }, label),
    field,
  );
}
