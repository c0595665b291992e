/** The dialogs *Picture* and *Video*: size, what is in the picture, format, and progress while it is made. */

import { FRAME_RATES } from '../../../edit/playback.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { videoFrames } from '../../../edit/video-frames.ts';
import { shownTake } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { UserError } from '../../../model/user-error.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { PictureOptions, Pictures, VideoFormat } from '../../state/pictures.ts';
import { untilClosed } from '../../state/until-closed.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, write } from '../../widgets/dom.ts';
import { type Answers, type Asked, askChoice, askNumber, Form } from '../../widgets/form/form.ts';
import { bytes, parseNumber, plural, shown } from '../../widgets/numbers/number-text.ts';

type Needs = Uses<'store' | 'transport' | 'viewport' | 'files' | 'messages' | 'dialog'>;
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

const SHOWN_OR_NOT = { shown: 'As shown', hidden: 'Hidden' };

export function pictureDialog(wb: Needs, close: () => void): DialogContent {
  const sizes = sizesOf(wb);
  const { form } = new PictureForm(wb, close, {
    about: 'A PNG of the viewport at the current time.',
    asked: pictureAsked(sizes),
    async make(form, pictures) {
      const content = await pictures.picture(pictureOptions(sizes, form));
      pictures.save(`${nameOf(wb)}.png`, content);
      return `${nameOf(wb)}.png was saved: ${bytes(content.size)}.`;
    },
  });
  return { title: 'Picture', body: form.element, kind: ASIDE };
}

export function videoDialog(wb: Needs, close: () => void): DialogContent {
  const { range, framesPerSecond } = wb.transport.get();
  const sizes = sizesOf(wb);
  const dialog = new PictureForm(wb, close, {
    about: 'The playback range, each frame drawn at its own time, however long that takes.',
    asked: [
      askChoice('format', 'Format', [], { autofocus: true }),
      askNumber('rate', 'Frame rate (fps)', framesPerSecond),
      askChoice(
        'speed',
        'Speed',
        SPEEDS.map((each) => [String(each), `${shown(each)}×`]),
        { value: '1' },
      ),
      ...pictureAsked(sizes, (answers) => answers.choice('format') === 'png'),
    ],
    changed: (field) => (field === 'size' ? list() : summarise()),
    async make(form, pictures, progress, signal) {
      // The options are those of the list.
      const format = form.choice('format') as VideoFormat;
      const stem = videoName(wb);
      const name = `${stem}.${FORMATS[format][1]}`;
      const content = await pictures.video(
        { ...pictureOptions(sizes, form), ...timing(form), range, format, name: stem },
        progress,
        signal,
      );
      pictures.save(name, content);
      return `${name} was saved: ${bytes(content.size)}.`;
    },
  });
  const { form } = dialog;
  const summarise = () => dialog.say(...summary(wb, form));
  /** Which formats can be written depends on the size. */
  const list = async () => {
    const pictures = await wb.files.pictures();
    const { width, height } = pictureOptions(sizes, form);
    const found = (await pictures?.formats(width, height)) ?? [];
    form.setOptions(
      'format',
      found.map((each) => [each, FORMATS[each][0]]),
    );
    form.showFields();
    summarise();
  };
  summarise();
  dialog.waitFor(list());
  return { title: 'Video', body: form.element, kind: ASIDE, stays: true };
}

/** @throws UserError */
function timing(form: Form): { readonly framesPerSecond: number; readonly speed: number } {
  const typed = parseNumber(form.text('rate'));
  if (typed === undefined || typed < FRAME_RATES[0] || typed > FRAME_RATES[1]) {
    throw new UserError(`The frame rate must be a number from ${FRAME_RATES[0]} to ${FRAME_RATES[1]}.`);
  }
  return { framesPerSecond: typed, speed: Number(form.choice('speed')) };
}

/** What comes, or why nothing does. */
function summary(wb: Needs, form: Form): readonly [text: string, isWrong: boolean] {
  const { range, loop } = wb.transport.get();
  try {
    const { framesPerSecond, speed } = timing(form);
    const { count } = videoFrames({ range, loop, framesPerSecond, rate: speed });
    const lost = countUnkeyed(wb.store.document, null);
    const note = lost > 0 ? ` ${plural(lost, 'unkeyed change')} will show in one frame only.` : '';
    const seconds = shown(count / framesPerSecond);
    const played = `Playback range: ${shown(range[0])} to ${shown(range[1])} s.`;
    return [`${plural(count, 'frame')}, ${seconds} s. ${played}${note}`, false];
  } catch (error) {
    return [sentenceOf(error), true];
  }
}

function sizesOf({ viewport }: Needs): readonly Size[] {
  const { clientWidth, clientHeight } = viewport.canvas;
  return [...TIMES.map((n): Size => [n * clientWidth, n * clientHeight]), ...USUAL_SIZES];
}

/** What both dialogs ask. */
function pictureAsked(sizes: readonly Size[], hasBackground?: (answers: Answers) => boolean): readonly Asked[] {
  const labels = sizes.map(([width, height], i): readonly [string, string] => {
    const pixels = `${width} × ${height}`;
    return [String(i), i >= TIMES.length ? pixels : `${pixels} (${TIMES[i]}×)`];
  });
  // The first choice of a dialog has the focus: the browser would give it to Cancel.
  const autofocus = true;
  return [
    askChoice('size', 'Size', labels, { autofocus }),
    askChoice(
      'background',
      'Background',
      { shown: 'As shown', hidden: 'Transparent' },
      { autofocus, ...(hasBackground && { shownIf: hasBackground }) },
    ),
    askChoice('grid', 'Grid', SHOWN_OR_NOT, { autofocus }),
    askChoice('tools', 'Selection and names', SHOWN_OR_NOT, { autofocus, value: 'hidden' }),
  ];
}

function pictureOptions(sizes: readonly Size[], form: Form) {
  const [width, height] = sizes[Number(form.choice('size'))];
  const isShown = (name: string) => form.choice(name) === 'shown';
  const parts = { hasBackground: isShown('background'), hasGrid: isShown('grid'), hasTools: isShown('tools') };
  return { width, height, ...parts } satisfies PictureOptions;
}

interface PictureParts {
  readonly about: string;
  readonly asked: readonly Asked[];
  changed?(field: string | undefined): void;
  /** Makes and saves it, and says so. */
  make(
    form: Form,
    pictures: Pictures,
    progress: (done: number, of: number) => void,
    signal: AbortSignal,
  ): Promise<string>;
}

/** A form whose summary says what comes or how far it is. Closing the dialog cancels. */
class PictureForm {
  readonly form: Form;
  private readonly bar = element('progress', { 'aria-label': 'Frames done', max: '1', value: '0', hidden: true });
  private readonly closed: AbortSignal;
  private isMaking = false;
  private isWrong = false;

  constructor(
    private readonly wb: Needs,
    private readonly close: () => void,
    private readonly parts: PictureParts,
  ) {
    this.form = new Form({
      about: parts.about,
      asked: parts.asked,
      below: [this.bar],
      apply: 'Save',
      changed: (field) => parts.changed?.(field),
      applied: () => void this.make(),
      close,
    });
    this.closed = untilClosed(wb);
  }

  say(text: string, isWrong = false): void {
    this.isWrong = isWrong;
    this.form.say(text, isWrong);
    this.form.allow(!isWrong && !this.isMaking);
  }

  /** Saving has to wait for it. */
  waitFor(until: Promise<void>): void {
    this.form.allow(false);
    until.then(
      () => this.form.allow(!this.isWrong),
      (error: unknown) => this.say(sentenceOf(error), true),
    );
  }

  private async make(): Promise<void> {
    const { wb, form, bar, closed } = this;
    this.isMaking = true;
    form.lock(true);
    form.allow(false);
    form.cancel.focus();
    try {
      const pictures = await wb.files.pictures();
      if (!pictures || closed.aborted) return;
      const progress = (done: number, of: number) => {
        write(bar, 'hidden', false);
        bar.max = of;
        bar.value = done;
        form.say(`Frame ${done} of ${of}`);
      };
      const text = await this.parts.make(form, pictures, progress, closed);
      this.close();
      wb.messages.note(text);
    } catch (error) {
      // Closed, so that nobody reads it.
      if (!closed.aborted) this.say(sentenceOf(error), true);
    } finally {
      this.isMaking = false;
      form.lock(false);
      write(bar, 'hidden', true);
      form.allow(!this.isWrong);
    }
  }
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
