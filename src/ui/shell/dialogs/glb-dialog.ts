/**
 * The dialog for saving GLB. The worker makes the file while the dialog is open, so that its size, its keys and what it
 * loses are measured, not guessed; saving hands out that very file.
 */

import { skinFacts } from '../../../evaluate/skin/bounds.ts';
import { DEFAULT_GLB, type GlbOptions } from '../../../export/glb/options.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { MadeGlb, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { atMostEvery } from '../../widgets/frame.ts';
import { parseNumber } from '../../widgets/numbers/number-text.ts';
import { fileText, takesText } from './glb-text.ts';

/** Between two files that are made while typing, in milliseconds. */
const PREVIEW_MS = 300;

export function glbDialog(wb: Uses<'store' | 'transport' | 'files' | 'dialog'>, close: () => void): DialogContent {
  const { characters } = wb.store.document;
  const first = currentCharacter(wb);
  const title = 'Save as GLB';
  const kind = 'tool-dialog glb-dialog';
  if (!first) return { title, kind, body: element('p', {}, 'There is nothing to save yet.') };

  const who = choice(
    characters.map(({ id, name }) => [id, name]),
    first.id,
  );
  const take = choice([], '');
  const keys = choice(
    [
      ['linear', 'Fewest keys, linear'],
      ['cubic', 'Fewest keys, cubic'],
      ['frames', 'One per frame, linear'],
    ],
    'linear',
  );
  const tolerance = field('1/2000 of size');
  const rate = field('');
  rate.value = String(wb.transport.get().framesPerSecond);
  const influences = choice([], '');
  const body = choice(
    [
      ['yes', 'Bones'],
      ['no', 'None'],
    ],
    'yes',
  );
  const said = element('p', { class: 'tool-result', role: 'status' });
  const takesSaid = element('p', { class: 'tool-result faint' });
  const losses = element('ul', { class: 'glb-losses' });
  const save = element('button', { type: 'submit', class: 'plain primary', disabled: true }, 'Save');
  const cancel = element('button', { type: 'button', class: 'plain' }, 'Cancel');
  const rows = {
    who: row('Character', who),
    take: row('Takes', take),
    keys: row('Keys', keys),
    tolerance: row('Tolerance', tolerance),
    rate: row('Frames per second', rate),
    influences: row('Attachments per vertex', influences),
    body: row('Body', body),
  };
  const form = element(
    'form',
    { class: 'tool-form' },
    element(
      'p',
      { class: 'faint' },
      'For Blender, game engines and the web: joints, skin, morphs, textures and takes.',
    ),
    ...Object.values(rows),
    said,
    takesSaid,
    losses,
    element('div', { class: 'tool-buttons' }, cancel, save),
  );

  const character = (): Character => findCharacter(wb.store.document, who.value) ?? first;
  const showAsked = () => {
    const { takes, skins, driver } = character();
    const skin = shownSkin(character());
    const most = skin ? skinFacts(skin).maxAttachments : 0;
    fill(take, [['', `All ${takes.length}`], ...takes.map(({ name }) => [name, name] as const)]);
    fill(influences, [
      ['', `All, up to ${most}`],
      ['4', 'The 4 strongest'],
    ]);
    write(rows.who, 'hidden', characters.length < 2);
    write(rows.take, 'hidden', driver !== undefined || takes.length < 2);
    write(rows.keys, 'hidden', takes.length === 0 && !driver);
    write(rows.tolerance, 'hidden', rows.keys.hidden || keys.value === 'frames');
    write(rows.rate, 'hidden', rows.keys.hidden || keys.value !== 'frames');
    write(rows.influences, 'hidden', most <= 4);
    write(rows.body, 'hidden', skins.length > 0);
  };

  let made: MadeGlb | undefined;
  let working = new AbortController();
  const refuse = (message: string) => {
    setText(said, message);
    said.classList.add('wrong');
    setText(takesSaid, '');
    losses.replaceChildren();
  };
  const options = (): GlbOptions | string => {
    const typed = tolerance.value.trim() === '' ? undefined : parseNumber(tolerance.value);
    const isFrames = keys.value === 'frames';
    if (!isFrames && tolerance.value.trim() !== '' && !(typed && typed > 0))
      return 'Tolerance must be a number greater than 0.';
    const framesPerSecond = parseNumber(rate.value) ?? 0;
    if (isFrames && !(framesPerSecond > 0)) return 'Frames per second must be a number greater than 0.';
    return {
      ...DEFAULT_GLB,
      keys: keys.value === 'cubic' ? 'cubic' : 'linear',
      body: body.value === 'yes',
      ...(isFrames && { framesPerSecond }),
      ...(!isFrames && typed !== undefined && { tolerance: typed }),
      ...(!rows.influences.hidden && influences.value === '4' && { influences: 4 }),
      ...(!rows.take.hidden && take.value !== '' && { take: take.value }),
    };
  };
  const make = async () => {
    working.abort();
    const own = new AbortController();
    working = own;
    made = undefined;
    write(save, 'disabled', true);
    const asked = options();
    if (typeof asked === 'string') return refuse(asked);
    said.classList.remove('wrong');
    setText(said, 'Working…');
    try {
      const one = await wb.files.makeGlb(character(), asked, {
        signal: own.signal,
        onProgress: (part) => setText(said, `Working… ${Math.floor(100 * part)}%`),
      });
      if (own.signal.aborted) return;
      made = one;
      write(save, 'disabled', false);
      setText(said, fileText(one.report, asked.framesPerSecond !== undefined));
      setText(takesSaid, takesText(one.report));
      losses.replaceChildren(
        ...one.report.losses.map(({ message, severity }) =>
          element('li', { class: severity === 'warning' ? 'wrong' : 'faint' }, message),
        ),
      );
    } catch (error) {
      if (!own.signal.aborted) refuse(sentenceOf(error));
    }
  };
  const soon = atMostEvery(PREVIEW_MS, () => void make());
  form.addEventListener('input', () => {
    showAsked();
    // What is shown is about other choices.
    write(save, 'disabled', true);
    soon();
  });
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    if (!made) return;
    const name = `${take.value && !rows.take.hidden ? take.value : character().name}.glb`;
    wb.files.saveBytes(name, made.bytes, 'model/gltf-binary');
    close();
  });
  cancel.addEventListener('click', close);
  const unsubscribe = wb.dialog.subscribe((shown) => {
    if (shown === 'glb') return;
    working.abort();
    unsubscribe();
  });
  showAsked();
  void make();
  return { title, kind, body: form };
}

type Option = readonly [value: string, label: string];

function choice(options: readonly Option[], value: string): HTMLSelectElement {
  const made = element('select', {});
  fill(made, options);
  made.value = value;
  return made;
}

/** Gives a list its options; what was chosen stays if it is still there. */
function fill(select: HTMLSelectElement, options: readonly Option[]): void {
  const { value } = select;
  select.replaceChildren(...options.map(([own, label]) => element('option', { value: own }, label)));
  select.value = options.some(([own]) => own === value) ? value : (options[0]?.[0] ?? '');
}

function field(placeholder: string): HTMLInputElement {
  return element('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    class: 'number-field',
    placeholder,
  });
}

function row(label: string, control: HTMLElement): HTMLElement {
  return element('label', { class: 'tool-field' }, element('span', {}, label), control);
}
