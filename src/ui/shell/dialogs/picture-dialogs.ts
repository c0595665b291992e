/** The dialogs *Picture* and *Video*: size, what is in the picture, format, and progress while it is made. */

import { FRAME_RATES } from '../../../edit/playback.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { videoFrames } from '../../../edit/video-frames.ts';
import { shownTake } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { PictureOptions, Pictures, VideoFormat } from '../../state/pictures.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { bytes, parseNumber, plural, shown } from '../../widgets/numbers/number-text.ts';

type Needs = Uses<'store' | 'transport' | 'viewport' | 'files' | 'messages' | 'dialog'>;
type Choices = readonly (readonly [value: string, label: string])[];
type Size = readonly [width: number, height: number];

const FORMATS: Readonly<Record<VideoFormat, readonly [label: string, extension: string]>> = {
  mp4: ['MP4 (H.264)', 'mp4'],
  webm: ['WebM (VP9)', 'webm'],
  gif: ['GIF', 'gif'],
  png: ['PNG sequence (.zip)', 'zip'],
};
const TIMES = [1, 2, 4] as const;
const USUAL_SIZES: readonly Size[] = [
  [1280, 720],
  [1920, 1080],
  [1080, 1080],
];
/** What is saved remains visible. */
const ASIDE = 'tool-dialog is-aside';
/** −4 to 4, as for playback, without 0. */
const SPEEDS = [4, 2, 1, 0.5, 0.25, -0.25, -0.5, -1, -2, -4] as const;

export function pictureDialog(wb: Needs, close: () => void): DialogContent {
  const form = pictureForm(wb, 'picture', close, 'A PNG of the viewport at the current time.');
  const inPicture = pictureFields(wb);
  form.fields.append(...inPicture.rows);
  form.onSubmit(async (pictures) => {
    const content = await pictures.picture(inPicture.options());
    pictures.save(`${nameOf(wb)}.png`, content);
    return `${nameOf(wb)}.png was saved: ${bytes(content.size)}.`;
  });
  return { title: 'Picture', body: form.body, kind: ASIDE };
}

export function videoDialog(wb: Needs, close: () => void): DialogContent {
  const { range, framesPerSecond, loop } = wb.transport.get();
  const about = 'The playback range, each frame drawn at its own time, however long that takes.';
  const form = pictureForm(wb, 'video', close, about);
  const inPicture = pictureFields(wb);
  const format = select([]);
  const rate = element('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    class: 'number-field',
    value: String(framesPerSecond),
  });
  const speed = select(
    SPEEDS.map((each) => [String(each), `${shown(each)}×`]),
    '1',
  );
  form.fields.append(row('Format', format), row('Frame rate (fps)', rate), row('Speed', speed), ...inPicture.rows);

  const asked = () => {
    const typed = parseNumber(rate.value);
    if (typed === undefined || typed < FRAME_RATES[0] || typed > FRAME_RATES[1]) {
      throw new Error(`The frame rate must be a number from ${FRAME_RATES[0]} to ${FRAME_RATES[1]}.`);
    }
    return { framesPerSecond: typed, speed: Number(speed.value) };
  };
  const summarise = () => {
    const isPng = format.value === 'png';
    write(inPicture.background, 'hidden', !isPng);
    try {
      const answers = asked();
      const { count } = videoFrames({ range, loop, framesPerSecond: answers.framesPerSecond, rate: answers.speed });
      const seconds = shown(count / answers.framesPerSecond);
      const lost = countUnkeyed(wb.store.document, null);
      const note = lost > 0 ? ` ${plural(lost, 'unkeyed change')} will show in one frame only.` : '';
      form.say(
        `${plural(count, 'frame')}, ${seconds} s. Playback range: ${shown(range[0])} to ${shown(range[1])} s.${note}`,
      );
    } catch (error) {
      form.say(messageOf(error), true);
    }
  };
  /** Which formats can be written depends on the size. */
  const list = async () => {
    const pictures = await wb.files.pictures();
    const [width, height] = inPicture.size();
    const found = (await pictures?.formats(width, height)) ?? [];
    const chosen = found.find((each) => each === format.value) ?? found[0];
    format.replaceChildren(...options(found.map((each) => [each, FORMATS[each][0]])));
    if (chosen) format.value = chosen;
    summarise();
  };
  form.body.addEventListener('input', (event) => (event.target === inPicture.sizes ? list() : summarise()));
  summarise();
  form.ready(list());
  form.onSubmit(async (pictures, progress, signal) => {
    // The options are those of the list.
    const chosen = format.value as VideoFormat;
    const stem = videoName(wb);
    const name = `${stem}.${FORMATS[chosen][1]}`;
    const content = await pictures.video(
      { ...inPicture.options(), ...asked(), range, format: chosen, name: stem },
      progress,
      signal,
    );
    pictures.save(name, content);
    return `${name} was saved: ${bytes(content.size)}.`;
  });
  return { title: 'Video', body: form.body, kind: ASIDE, stays: true };
}

/** What both dialogs ask. */
function pictureFields(wb: Needs) {
  const { clientWidth, clientHeight } = wb.viewport.canvas;
  const all: Size[] = [...TIMES.map((n): Size => [n * clientWidth, n * clientHeight]), ...USUAL_SIZES];
  const labels = all.map(([width, height], i) => {
    const pixels = `${width} × ${height}`;
    return i >= TIMES.length ? pixels : `${pixels} (${TIMES[i]}×)`;
  });
  const sizes = select(labels.map((label, i) => [String(i), label]));
  const background = select([
    ['shown', 'As shown'],
    ['hidden', 'Transparent'],
  ]);
  const shownOrNot: Choices = [
    ['shown', 'As shown'],
    ['hidden', 'Hidden'],
  ];
  const grid = select(shownOrNot);
  const tools = select(shownOrNot, 'hidden');
  const size = () => all[Number(sizes.value)];
  const rows = {
    size: row('Size', sizes),
    background: row('Background', background),
    grid: row('Grid', grid),
    tools: row('Selection and names', tools),
  };
  const picked = (): PictureOptions => {
    const [width, height] = size();
    return {
      width,
      height,
      hasBackground: background.value === 'shown',
      hasGrid: grid.value === 'shown',
      hasTools: tools.value === 'shown',
    };
  };
  return { sizes, size, background: rows.background, rows: Object.values(rows), options: picked };
}

type Make = (pictures: Pictures, progress: (done: number, of: number) => void, signal: AbortSignal) => Promise<string>;

/** Fields, a line that says what comes or how far it is, and buttons. Closing the dialog cancels. */
function pictureForm(wb: Needs, name: 'picture' | 'video', close: () => void, about: string) {
  const save = element('button', { type: 'submit', class: 'plain primary' }, 'Save');
  const cancel = element('button', { type: 'button', class: 'plain' }, 'Cancel');
  const fields = element('fieldset', { class: 'tool-fields' });
  const bar = element('progress', { 'aria-label': 'Frames done', max: '1', value: '0', hidden: true });
  const line = element('p', { class: 'tool-result', role: 'status' });
  const body = element(
    'form',
    { class: 'tool-form' },
    element('p', { class: 'faint' }, about),
    fields,
    line,
    bar,
    element('div', { class: 'tool-buttons' }, cancel, save),
  );
  let making: AbortController | undefined;
  let isWrong = false;
  const say = (text: string, wrong = false) => {
    isWrong = wrong;
    setText(line, text);
    line.classList.toggle('wrong', wrong);
    write(save, 'disabled', wrong || making !== undefined);
  };
  const stop = wb.dialog.subscribe((open) => {
    if (open === name) return;
    making?.abort();
    stop();
  });
  cancel.addEventListener('click', close);
  const run = async (make: Make) => {
    const own = new AbortController();
    making = own;
    write(fields, 'disabled', true);
    write(save, 'disabled', true);
    cancel.focus();
    try {
      const pictures = await wb.files.pictures();
      if (!pictures || own.signal.aborted) return;
      const progress = (done: number, of: number) => {
        write(bar, 'hidden', false);
        bar.max = of;
        bar.value = done;
        setText(line, `Frame ${done} of ${of}`);
      };
      const text = await make(pictures, progress, own.signal);
      close();
      wb.messages.note(text);
    } catch (error) {
      // Closed, so that nobody reads it.
      if (!own.signal.aborted) say(messageOf(error), true);
    } finally {
      making = undefined;
      write(fields, 'disabled', false);
      write(bar, 'hidden', true);
      write(save, 'disabled', isWrong);
    }
  };
  return {
    body,
    fields,
    say,
    /** Saving has to wait for it. */
    ready(until: Promise<void>) {
      write(save, 'disabled', true);
      until.then(
        () => {
          write(save, 'disabled', isWrong);
        },
        (error: unknown) => say(messageOf(error), true),
      );
    },
    onSubmit(make: Make) {
      body.addEventListener('submit', (event) => {
        event.preventDefault();
        if (!save.disabled) void run(make);
      });
    },
  };
}

function row(label: string, field: HTMLElement): HTMLElement {
  return element('label', { class: 'tool-field' }, element('span', {}, label), field);
}

function select(choices: Choices, value?: string): HTMLSelectElement {
  // The first one of a dialog: the browser would focus Cancel.
  const made = element('select', { autofocus: true }, ...options(choices));
  if (value !== undefined) made.value = value;
  return made;
}

function options(choices: Choices): HTMLOptionElement[] {
  return choices.map(([value, label]) => element('option', { value }, label));
}

function nameOf(wb: Needs): string {
  return fileName(currentCharacter(wb)?.name ?? '');
}

function videoName(wb: Needs): string {
  const character = currentCharacter(wb);
  return fileName((character && shownTake(character)?.name) ?? character?.name ?? '');
}

/** Without what file systems don't take. */
function fileName(name: string): string {
  return name.replace(/[\s/\\:*?"<>|]+/g, '_') || 'marrow';
}

function messageOf(error: unknown): string {
  return sentenceOf(error);
}
