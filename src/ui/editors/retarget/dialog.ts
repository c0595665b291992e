/**
 * The retargeting dialog: which character, whose take, which joint follows which, and a few options. The result is
 * previewed behind the dialog; one undo step when applied, none when closed.
 */

import { CommandError } from '../../../edit/command-error.ts';
import { bakeRetarget, clearRetarget, setRetarget } from '../../../edit/commands/retarget.ts';
import { driverSource, possibleSources } from '../../../edit/follow/sources.ts';
import { intoRange, pause, play } from '../../../edit/playback.ts';
import { retargetPlan } from '../../../evaluate/retarget/make-plan.ts';
import { automaticPairs, type MatchedPair } from '../../../evaluate/retarget/match.ts';
import { measureRetarget } from '../../../evaluate/retarget/measure.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../../model/document.ts';
import type { JointPair, RetargetOptions } from '../../../model/takes/retarget.ts';
import { stopsOnFrame } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { type Asked, askChoice, askNumber, type Choices, type Form, plainButton } from '../../widgets/form/form.ts';
import { icon } from '../../widgets/icons.ts';
import { parseNumber, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { type OtherEnd, toolDialog } from '../timeline/tool-dialog.ts';
import { pairTable } from './pair-table.ts';
import { retargetText } from './result-text.ts';
import { firstTarget, possibleTargets } from './targets.ts';

const TITLE = 'Retarget take';
const KIND = 'retarget-dialog';
/** Contacts measured per foot for the summary: a long take has thousands. */
const MEASURED = 24;

type Parts = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'dialog'>;
type Args = Parameters<typeof setRetarget.run>[1];

export function retargetDialog(wb: Parts, close: () => void): DialogContent {
  const first = firstTarget(wb);
  if (first) return new Retargeting(wb, close, first).dialog;
  const text = 'Open a take and another character with a skeleton first.';
  return { title: TITLE, kind: `tool-dialog ${KIND}`, body: element('div', {}, element('p', {}, text)) };
}

class Retargeting {
  readonly dialog: DialogContent;
  private readonly base: Document;
  private readonly table = pairTable();
  private readonly stop = plainButton('Stop retargeting', () => {});
  private sourceId = '';
  private matches: readonly MatchedPair[] = [];
  /** The time that `Current time` means: when the dialog was opened, even while playing. */
  private moment = 0;

  constructor(
    private readonly wb: Parts,
    close: () => void,
    private target: Character,
  ) {
    this.base = wb.store.document;
    const opened = wb.transport.get();
    const wasInRange = intoRange(opened) === opened;
    const sources = this.chooseSource();
    this.dialog = toolDialog<Args>(wb, close, {
      title: TITLE,
      kind: KIND,
      applyTooltip: 'Live: follows the other character’s take as it is edited',
      asked: [
        askChoice(
          'target',
          'Character',
          options(possibleTargets(this.base), (c) => c.name),
          {
            value: target.id,
            autofocus: true,
          },
        ),
        askChoice('source', 'Source', options(sources, sourceName), { value: this.sourceId }),
        this.table.element,
        ...this.optionsAsked(),
      ],
      buttons: this.buttons(),
      others: this.otherEnds(),
      command: setRetarget,
      args: (form) => this.args(form),
      changed: (field, form) => this.changed(field, form),
      result: (_, after, form) => this.result(after, form),
      applied: () => this.applied(wasInRange),
    });
  }

  private optionsAsked(): Asked[] {
    const { scale, reference, plantsFeet } = this.optionsHeld() ?? {};
    return [
      askNumber('scale', 'Root motion scale', scale),
      askChoice(
        'reference',
        'Reference pose',
        { automatic: 'Automatic', rest: 'File pose', now: 'Current time' },
        { value: typeof reference === 'number' ? 'now' : (reference ?? 'automatic') },
      ),
      {
        kind: 'check',
        name: 'feet',
        label: 'Plant feet where the source plants them',
        value: plantsFeet ?? true,
      },
    ];
  }

  private buttons(): HTMLElement[] {
    const { transport } = this.wb;
    const playing = button('Play or pause', { class: 'tool' }, icon('play'), () =>
      transport.update((p) => (p.playing ? pause(p, stopsOnFrame(this.wb)) : play(p))),
    );
    const again = plainButton('Rematch joints', () => {
      this.match();
      this.table.tellChanged();
    });
    return [playing, again, this.stop, element('span', { class: 'spacer' })];
  }

  private otherEnds(): OtherEnd<Args>[] {
    const bake = plainButton('Bake', () => {});
    setTooltip(bake, 'Creates a take of the character’s own, with a pose for every frame');
    return [
      {
        button: this.stop,
        appliesAnswers: false,
        change: (base) => {
          const one = { characterId: this.target.id };
          return { document: clearRetarget.run(base, one), label: clearRetarget.label(base, one) };
        },
      },
      {
        button: bake,
        appliesAnswers: true,
        change: (base, args) => {
          const made = setRetarget.run(base, args());
          const one = { characterId: this.target.id };
          return { document: bakeRetarget.run(made, one), label: bakeRetarget.label(made, one) };
        },
      },
    ];
  }

  private args(form: Form): Args {
    const typed = form.text('scale');
    const scale = parseNumber(typed);
    if (typed !== '' && scale === undefined)
      throw new CommandError('The scale must be a number, or empty for automatic.');
    const reference = form.choice('reference');
    return {
      characterId: this.target.id,
      sourceId: this.sourceId,
      pairs: this.table.pairs(),
      options: {
        scale,
        reference: reference === 'now' ? this.moment : reference === 'rest' ? 'rest' : 'automatic',
        plantsFeet: form.isChecked('feet'),
      },
    };
  }

  private result(after: Document, form: Form): string {
    const moved = findCharacter(after, this.target.id);
    if (!moved?.driver || !moved.skeleton) return '';
    const plan = retargetPlan(moved.driver, moved, moved.skeleton);
    const [scale, reference] = [form.control('scale'), form.control('reference')];
    if (scale instanceof HTMLInputElement && form.text('scale') === '')
      write(scale, 'placeholder', `automatic: ${shown(plan.scale)}`);
    const isFixed = plan.sameBones.directions;
    write(reference, 'disabled', isFixed);
    setTooltip(reference, isFixed ? 'Both skeletons have the same bones: their file poses match' : '');
    return retargetText(moved.driver, moved.skeleton, measureRetarget(moved, MEASURED));
  }

  private changed(field: string | undefined, form: Form): void {
    if (field === 'target') {
      this.target = findCharacter(this.base, form.choice('target')) ?? this.target;
      form.setOptions('source', options(this.chooseSource(), sourceName), this.sourceId);
      for (const asked of this.optionsAsked()) form.reset(asked);
    }
    if (field === 'source') this.sourceId = form.choice('source');
    if (field === 'source' || (field === 'reference' && form.choice('reference') === 'now')) {
      this.moment = this.secondsNow(findCharacter(this.base, this.sourceId));
    }
    if (field === 'source') this.match();
  }

  private optionsHeld(): RetargetOptions | undefined {
    const { driver } = this.target;
    return driver?.sourceId === this.sourceId ? driver.options : undefined;
  }

  /** The sources of the target; one of them is chosen. */
  private chooseSource(): readonly Character[] {
    const { base, target, wb } = this;
    const { driver } = target;
    const possible = possibleSources(base, target);
    const held = driver && possible.find((c) => c.id === driver.sourceId);
    // The selected character if possible; else the last one opened.
    const meant = held ?? possible.find((c) => c.id === wb.store.selection.characterId) ?? possible.at(-1);
    this.sourceId = meant?.id ?? '';
    const reference = this.optionsHeld()?.reference;
    this.moment = typeof reference === 'number' ? reference : this.secondsNow(meant);
    write(this.stop, 'hidden', !driver);
    this.match(held && driver?.pairs);
    return possible;
  }

  private match(pairs?: readonly JointPair[]): void {
    const { target } = this;
    const from = findCharacter(this.base, this.sourceId);
    const source = from && driverSource(from);
    if (!source || !target.skeleton) return;
    this.matches = automaticPairs(source.skeleton, target.skeleton, source.space, target.space);
    this.table.show(target.skeleton, source.skeleton, pairs ?? this.matches, this.matches);
  }

  private applied(wasInRange: boolean): void {
    const { store, transport, messages, dialog } = this.wb;
    const { id, name } = this.target;
    // What was made is in hand: its curves, and the ways to continue from it.
    if (store.selection.characterId !== id) store.select({ characterId: id });
    // The range may have become that of a shorter take.
    if (wasInRange) transport.update(intoRange);
    if (!findCharacter(store.document, id)?.driver) return;
    const from = findCharacter(this.base, this.sourceId);
    const take = (from && shownTake(from)?.name) || 'a take';
    const check = { label: 'Check take…', run: () => dialog.set('checkTake') };
    messages.confirm(`${name} plays ${take}. Measure plots its feet and speeds.`, check);
  }

  /** The transport's time in seconds of a character's take. */
  private secondsNow(character: Character | undefined): number {
    return this.wb.transport.get().timeSeconds + (character?.timeOffsetSeconds ?? 0);
  }
}

function options(characters: readonly Character[], textOf: (character: Character) => string): Choices {
  return characters.map((c) => [c.id, textOf(c)]);
}

/** A motion capture take has its character's name: don't repeat it. */
function sourceName(character: Character): string {
  const take = shownTake(character)?.name ?? '';
  return take === character.name ? take : `${character.name} · ${take}`;
}
