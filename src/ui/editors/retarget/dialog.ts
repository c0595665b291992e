/**
 * The retargeting dialog: which character, whose take, which joint follows which, and a few options. The result is
 * previewed behind the dialog; one undo step when applied, none when closed.
 */

import { CommandError } from '../../../edit/command-error.ts';
import { bakeRetarget, clearRetarget, setRetarget } from '../../../edit/commands/retarget.ts';
import { cutName, SHORT_NAME } from '../../../edit/cut-name.ts';
import { driverSource, possibleSources } from '../../../edit/drivers.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import { intoRange, pause, play } from '../../../edit/playback.ts';
import { retargetPlan } from '../../../evaluate/retarget/make-plan.ts';
import { automaticPairs, type MatchedPair } from '../../../evaluate/retarget/match.ts';
import { measureRetarget } from '../../../evaluate/retarget/measure.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../../model/document.ts';
import type { JointPair, RetargetOptions } from '../../../model/takes/retarget.ts';
import type { Offer } from '../../state/messages.ts';
import { stopsOnFrame } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { button, element, setText, write } from '../../widgets/dom.ts';
import { atMostEvery } from '../../widgets/frame.ts';
import { icon } from '../../widgets/icons.ts';
import { parseNumber, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { pairTable } from './pair-table.ts';
import { retargetText } from './result-text.ts';
import { firstTarget, possibleTargets } from './targets.ts';

const TITLE = 'Retarget take';
/** Minimum interval of previews while typing. */
const PREVIEW_MS = 120;
/** Contacts measured per foot for the summary: a long take has thousands. */
const MEASURED = 24;

export function retargetDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  const { store } = wb;
  const kind = 'tool-dialog retarget-dialog';
  const first = firstTarget(wb);
  if (!first) {
    const text = 'Open a take and another character with a skeleton first.';
    return { title: TITLE, kind, body: element('div', {}, element('p', {}, text)) };
  }
  const preview = new EditPreview(store, TITLE, () => {
    wb.messages.note(`${TITLE} was not applied because the document has changed. Try again.`, 'warning');
    stop();
    close();
  });
  const { base } = preview;
  const opened = wb.transport.get();
  const wasInRange = intoRange(opened) === opened;
  let target = first;
  let matches: readonly MatchedPair[] = [];

  const targets = choice(possibleTargets(base).map((c) => [c.id, c.name]));
  targets.autofocus = true;
  const sources = choice([]);
  const scale = element('input', { type: 'text', inputmode: 'decimal', autocomplete: 'off', class: 'number-field' });
  const reference = choice([
    ['automatic', 'Automatic'],
    ['rest', 'File pose'],
    ['now', 'Current time'],
  ]);
  const feet = element('input', { type: 'checkbox' });
  const result = element('p', { class: 'tool-result', role: 'status' });
  const table = pairTable(() => soon());
  const apply = element('button', { type: 'submit', class: 'plain primary' }, 'Apply');
  const bake = element('button', { type: 'button', class: 'plain' }, 'Bake');
  const takeOff = element('button', { type: 'button', class: 'plain' }, 'Stop retargeting');
  const again = element('button', { type: 'button', class: 'plain' }, 'Rematch joints');
  const cancel = element('button', { type: 'button', class: 'plain' }, 'Cancel');
  setTooltip(bake, 'Creates a take of the character’s own, with a pose for every frame');
  setTooltip(apply, 'Live: follows the other character’s take as it is edited');
  const body = element(
    'form',
    { class: 'tool-form' },
    field('Character', targets),
    field('Source', sources),
    table.element,
    field('Root motion scale', scale),
    field('Reference pose', reference),
    element('label', { class: 'tool-check' }, feet, element('span', {}, 'Plant feet where the source plants them')),
    result,
    element(
      'div',
      { class: 'tool-buttons' },
      button('Play or pause', { class: 'tool' }, icon('play'), () =>
        wb.transport.update((p) => (p.playing ? pause(p, stopsOnFrame(wb)) : play(p))),
      ),
      again,
      takeOff,
      element('span', { class: 'spacer' }),
      cancel,
      bake,
      apply,
    ),
  );

  /** The time that `Current time` means: when the dialog was opened, even while playing. */
  let moment = 0;
  const optionsNow = (): Partial<RetargetOptions> => {
    const typed = scale.value.trim();
    const number = parseNumber(typed);
    if (typed !== '' && number === undefined)
      throw new CommandError('The scale must be a number, or empty for automatic.');
    return {
      scale: number,
      reference: reference.value === 'now' ? moment : reference.value === 'rest' ? 'rest' : 'automatic',
      plantsFeet: feet.checked,
    };
  };
  const made = (): Document =>
    setRetarget.run(base, {
      characterId: target.id,
      sourceId: sources.value,
      pairs: table.pairs(),
      options: optionsNow(),
    });
  const sourceTake = () => {
    const from = findCharacter(base, sources.value);
    return (from && shownTake(from)?.name) || 'a take';
  };
  const attempt = (work: () => void) => {
    if (preview.over) return;
    try {
      work();
      result.classList.remove('wrong');
      for (const each of [apply, bake]) write(each, 'disabled', false);
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      preview.show(base);
      setText(result, error.message);
      result.classList.add('wrong');
      for (const each of [apply, bake]) write(each, 'disabled', true);
    }
  };
  const showPreview = () =>
    attempt(() => {
      const after = made();
      preview.show(after);
      const moved = findCharacter(after, target.id);
      if (!moved?.driver || !moved.skeleton) return;
      const plan = retargetPlan(moved.driver, moved, moved.skeleton);
      if (scale.value.trim() === '') write(scale, 'placeholder', `automatic: ${shown(plan.scale)}`);
      const isFixed = plan.sameBones.directions;
      write(reference, 'disabled', isFixed);
      setTooltip(reference, isFixed ? 'Both skeletons have the same bones: their file poses match' : '');
      setText(result, retargetText(moved.driver, moved.skeleton, measureRetarget(moved, MEASURED)));
    });
  const soon = atMostEvery(PREVIEW_MS, showPreview);

  const match = (pairs?: readonly JointPair[]) => {
    const from = findCharacter(base, sources.value);
    const source = from && driverSource(from);
    if (!source || !target.skeleton) return;
    matches = automaticPairs(source.skeleton, target.skeleton, source.space, target.space);
    table.show(target.skeleton, source.skeleton, pairs ?? matches, matches);
  };
  const showSources = () => {
    const possible = possibleSources(base, target);
    const held = target.driver && possible.find((c) => c.id === target.driver?.sourceId);
    // The selected character if possible; else the last one opened.
    const meant = held ?? possible.find((c) => c.id === store.selection.characterId) ?? possible.at(-1);
    sources.replaceChildren(
      ...possible.map((c) => element('option', { value: c.id, selected: c === meant }, sourceName(c))),
    );
    const options = held && target.driver ? target.driver.options : undefined;
    scale.value = options?.scale === undefined ? '' : String(options.scale);
    moment = typeof options?.reference === 'number' ? options.reference : takeSecondsNow(wb, meant);
    reference.value = typeof options?.reference === 'number' ? 'now' : (options?.reference ?? 'automatic');
    feet.checked = options?.plantsFeet ?? true;
    write(takeOff, 'hidden', !target.driver);
    match(held && target.driver?.pairs);
  };

  const stop = wb.dialog.subscribe((open) => {
    if (open !== 'retarget') end();
  });
  function end(keep?: () => Document, label?: string): void {
    if (preview.over) return;
    if (keep) attempt(() => preview.show(keep()));
    if (apply.disabled && keep) return;
    stop();
    if (!keep) {
      preview.putBack();
      return;
    }
    preview.keep(label);
    // What was made is in hand: its curves, and the ways to continue from it.
    if (store.selection.characterId !== target.id) store.select({ characterId: target.id });
    // The range may have become that of a shorter take.
    if (wasInRange) wb.transport.update(intoRange);
    close();
    if (findCharacter(store.document, target.id)?.driver) {
      const check: Offer = { label: 'Check take…', run: () => wb.dialog.set('checkTake') };
      wb.messages.confirm(`${target.name} plays ${sourceTake()}. Measure plots its feet and speeds.`, check);
    }
  }

  targets.addEventListener('change', () => {
    target = findCharacter(base, targets.value) ?? target;
    showSources();
    soon();
  });
  sources.addEventListener('change', () => {
    moment = takeSecondsNow(wb, findCharacter(base, sources.value));
    match();
    soon();
  });
  reference.addEventListener('change', () => {
    if (reference.value === 'now') moment = takeSecondsNow(wb, findCharacter(base, sources.value));
    soon();
  });
  scale.addEventListener('input', soon);
  feet.addEventListener('change', soon);
  again.addEventListener('click', () => {
    match();
    soon();
  });
  cancel.addEventListener('click', close);
  takeOff.addEventListener('click', () =>
    end(
      () => clearRetarget.run(base, { characterId: target.id }),
      clearRetarget.label(base, { characterId: target.id }),
    ),
  );
  bake.addEventListener('click', () =>
    end(
      () => bakeRetarget.run(made(), { characterId: target.id }),
      `Bake ${cutName(sourceTake(), SHORT_NAME)} into ${cutName(target.name, SHORT_NAME)}`,
    ),
  );
  body.addEventListener('submit', (event) => {
    event.preventDefault();
    if (!apply.disabled)
      end(made, `Retarget ${cutName(sourceTake(), SHORT_NAME)} to ${cutName(target.name, SHORT_NAME)}`);
  });
  targets.value = target.id;
  showSources();
  showPreview();
  return { title: TITLE, body, kind };
}

/** The transport's time in seconds of a character's take. */
function takeSecondsNow(wb: Uses<'transport'>, character: Character | undefined): number {
  return wb.transport.get().timeSeconds + (character?.timeOffsetSeconds ?? 0);
}

function choice(options: readonly (readonly [string, string])[]): HTMLSelectElement {
  return element('select', {}, ...options.map(([value, label]) => element('option', { value }, label)));
}

function field(label: string, content: HTMLElement): HTMLElement {
  return element('label', { class: 'tool-field' }, element('span', {}, label), content);
}

/** A motion capture take has its character's name: don't repeat it. */
function sourceName(character: Character): string {
  const take = shownTake(character)?.name ?? '';
  return take === character.name ? take : `${character.name} · ${take}`;
}
