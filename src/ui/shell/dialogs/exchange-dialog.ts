/**
 * The dialog for saving a character for other programs. The worker makes the file while the dialog is open, so that its size, its keys and what it
 * loses are measured, not guessed; saving hands out that very file.
 */

import { skinFacts } from '../../../evaluate/skin/bounds.ts';
import { EXCHANGES } from '../../../export/exchange.ts';
import { EXCHANGE_LABELS, type ExchangeFormat } from '../../../export/formats.ts';
import { DEFAULT_GLB, type GlbOptions } from '../../../export/glb/options.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import { UserError } from '../../../model/user-error.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { untilClosed } from '../../state/until-closed.ts';
import type { MadeExchange, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText } from '../../widgets/dom.ts';
import { type Answers, type Asked, askChoice, askNumber, Form } from '../../widgets/form/form.ts';
import { atMostEvery } from '../../widgets/frame.ts';
import { parseNumber } from '../../widgets/numbers/number-text.ts';
import { fileText, takesText } from './exchange-text.ts';

/** Between two files that are made while typing, in milliseconds. */
const PREVIEW_MS = 300;
const KIND = 'tool-dialog exchange-dialog';

type Parts = Uses<'store' | 'transport' | 'files' | 'dialog'>;

/** Makes the dialog of a format. */
export function exchangeDialog(format: ExchangeFormat): (wb: Parts, close: () => void) => DialogContent {
  return (wb, close) => {
    const first = currentCharacter(wb);
    const body = first
      ? new Saving(wb, close, format, first).form.element
      : element('p', {}, 'There is nothing to save yet.');
    return { title: `Save as ${EXCHANGE_LABELS[format]}`, kind: KIND, body };
  };
}

class Saving {
  readonly form: Form;
  private readonly takes = element('p', { class: 'tool-result faint' });
  private readonly losses = element('ul', { class: 'exchange-losses' });
  private made: MadeExchange | undefined;
  private working = new AbortController();

  constructor(
    private readonly wb: Parts,
    close: () => void,
    private readonly format: ExchangeFormat,
    private readonly first: Character,
  ) {
    const { about, mime } = EXCHANGES[format];
    const soon = atMostEvery(PREVIEW_MS, () => void this.make());
    this.form = new Form({
      about,
      asked: this.asked(wb.store.document.characters),
      below: [this.takes, this.losses],
      apply: 'Save',
      changed: (field) => {
        if (field === 'who') this.showOptions();
        // What is shown is about other choices.
        this.form.allow(false);
        soon();
      },
      applied: () => {
        if (!this.made) return;
        wb.files.saveBytes(`${this.take() ?? this.character().name}.${format}`, this.made.bytes, mime);
        close();
      },
      close,
    });
    untilClosed(wb).addEventListener('abort', () => this.working.abort());
    this.showOptions();
    void this.make();
  }

  private asked(characters: readonly Character[]): readonly Asked[] {
    const isMoved = () => this.character().takes.length > 0 || this.character().driver !== undefined;
    const isFrames = (answers: Answers) => answers.choice('keys') === 'frames';
    return [
      askChoice(
        'who',
        'Character',
        characters.map(({ id, name }) => [id, name]),
        { value: this.first.id, shownIf: () => characters.length > 1 },
      ),
      askChoice('take', 'Takes', [], { shownIf: () => !this.character().driver && this.character().takes.length > 1 }),
      askChoice(
        'keys',
        'Keys',
        {
          ...(this.has('keys')
            ? { linear: 'Fewest keys, linear', cubic: 'Fewest keys, cubic' }
            : { linear: 'As they are' }),
          frames: 'One per frame, linear',
        },
        { shownIf: isMoved },
      ),
      askNumber('tolerance', 'Tolerance', undefined, {
        placeholder: '1/2000 of size',
        shownIf: (answers) => isMoved() && !isFrames(answers),
      }),
      askNumber('rate', 'Frames per second', this.wb.transport.get().framesPerSecond, {
        shownIf: (answers) => isMoved() && isFrames(answers),
      }),
      askChoice('influences', 'Attachments per vertex', [], { shownIf: () => this.mostAttachments() > 4 }),
      askChoice(
        'body',
        'Body',
        { yes: 'Boxes and bones', no: 'None' },
        { shownIf: () => this.has('body') && !this.character().skins.length },
      ),
    ];
  }

  /** Whether an option means something in the format. */
  private has(option: keyof GlbOptions): boolean {
    return !EXCHANGES[this.format].ignores.includes(option);
  }

  private character(): Character {
    return findCharacter(this.wb.store.document, this.form?.choice('who') ?? '') ?? this.first;
  }

  private mostAttachments(): number {
    const skin = shownSkin(this.character());
    return skin ? skinFacts(skin).maxAttachments : 0;
  }

  private showOptions(): void {
    const { takes } = this.character();
    const named = takes.map(({ name }) => [name, name] as const);
    this.form.setOptions('take', [['', `All ${takes.length}`], ...named]);
    this.form.setOptions('influences', [
      ['', `All, up to ${this.mostAttachments()}`],
      ['4', 'The 4 strongest'],
    ]);
  }

  /** The only one that is saved; undefined: all. */
  private take(): string | undefined {
    return (this.form.isShown('take') && this.form.choice('take')) || undefined;
  }

  /** @throws UserError */
  private options(): GlbOptions {
    const { form } = this;
    const keys = form.choice('keys');
    const isFrames = keys === 'frames';
    const typed = form.text('tolerance') === '' ? undefined : parseNumber(form.text('tolerance'));
    if (!isFrames && form.text('tolerance') !== '' && !(typed && typed > 0))
      throw new UserError('Tolerance must be a number greater than 0.');
    const framesPerSecond = parseNumber(form.text('rate')) ?? 0;
    if (isFrames && !(framesPerSecond > 0)) throw new UserError('Frames per second must be a number greater than 0.');
    const take = this.take();
    return {
      ...DEFAULT_GLB,
      keys: keys === 'cubic' ? 'cubic' : 'linear',
      body: form.choice('body') === 'yes',
      ...(isFrames && { framesPerSecond }),
      ...(!isFrames && typed !== undefined && { tolerance: typed }),
      ...(form.isShown('influences') && form.choice('influences') === '4' && { influences: 4 }),
      ...(take !== undefined && { take }),
    };
  }

  private async make(): Promise<void> {
    const { form, wb } = this;
    this.working.abort();
    const own = new AbortController();
    this.working = own;
    this.made = undefined;
    form.allow(false);
    try {
      const asked = this.options();
      form.say('Working…');
      const one = await wb.files.makeExchange(
        { format: this.format, character: this.character(), options: asked },
        { signal: own.signal, onProgress: (part) => form.say(`Working… ${Math.floor(100 * part)}%`) },
      );
      if (!own.signal.aborted) this.show(one, asked.framesPerSecond !== undefined);
    } catch (error) {
      if (own.signal.aborted) return;
      form.say(sentenceOf(error), true);
      setText(this.takes, '');
      this.losses.replaceChildren();
    }
  }

  private show(made: MadeExchange, isExactAtFrames: boolean): void {
    this.made = made;
    this.form.allow(true);
    this.form.say(fileText(made.report, isExactAtFrames));
    setText(this.takes, takesText(made.report));
    this.losses.replaceChildren(
      ...made.report.losses.map(({ message, severity }) =>
        element('li', { class: severity === 'warning' ? 'wrong' : 'faint' }, message),
      ),
    );
  }
}
