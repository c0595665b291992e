/**
 * Messages: problems in files, and short notices. They stay until read; nothing here interrupts. A file's problems are
 * one message with all diagnostics, so that a hundred warnings are one line.
 */

import type { Diagnostic, Severity } from '../../model/diagnostic.ts';
import { cutMessage } from '../../model/names/cut-text.ts';
import { type Observable, observable } from '../widgets/observable.ts';

export interface Message {
  readonly id: number;
  readonly severity: Severity;
  /** One line. */
  readonly text: string;
  /** In the files' order; empty for a plain notice. */
  readonly diagnostics: readonly Diagnostic[];
  /** What happened to the file: `not opened`. */
  readonly fate?: string;
  /** Still shown in the line over the viewport. */
  readonly unread: boolean;
  /** What can be done about it, as buttons. */
  readonly offers?: readonly Offer[];
  /** The next step removes it from the line, since it was about a previous attempt. */
  readonly isRefusal?: boolean;
  /** Whether what it says is over; it then leaves the line. */
  readonly isOver?: IsOver;
}

/** Asked after changes of the document, the selection and the mode. */
export type IsOver = () => boolean;

/** What a message offers to do, as a button. */
export interface Offer {
  readonly label: string;
  run(): void;
}

/** How long a warning stays in the line: a refusal until the next step. */
type Lasting = 'until a step' | 'until read';

export class Messages {
  /** Oldest first, without problems that are over; changed by methods only. */
  readonly list: Observable<readonly Message[]> = observable<readonly Message[]>([]);
  /** A confirmation: shown briefly, never listed. */
  readonly passing: Observable<string | undefined> = observable<string | undefined>(undefined);
  /** Of the passing message. */
  offers: readonly Offer[] = [];
  /** Whether the passing message stays until it is over: nobody need be quick to take an offer. */
  lasts = false;
  private passingIsOver: IsOver | undefined;
  /** Counts requests to show the list. */
  readonly listAsked: Observable<number> = observable(0);
  /** With problems that are over, which undo may bring back. */
  private all: readonly Message[] = [];
  private isSettled: (problem: Diagnostic) => boolean = () => false;
  private nextId = 1;
  private given = 0;

  /**
   * Adds a notice of one sentence. An info disappears by itself; anything worse is listed.
   *
   * @param lasting for warnings; an error stays in the line until read
   * @param isOver when what it says is no longer so
   */
  note(text: string, severity: Severity = 'info', lasting: Lasting = 'until a step', isOver?: IsOver): void {
    this.given++;
    this.offers = [];
    this.lasts = false;
    if (severity === 'info') {
      this.passingIsOver = isOver;
      this.passing.set(cutMessage(text));
    } else {
      const isRefusal = severity === 'warning' && lasting === 'until a step';
      this.add({ text, severity, diagnostics: [], ...(isRefusal && { isRefusal }), ...(isOver && { isOver }) });
    }
  }

  /** Adds an error with buttons. It stays in the line until read. */
  fault(text: string, offers: readonly Offer[]): void {
    this.given++;
    this.offers = [];
    this.add({ text, severity: 'error', diagnostics: [], offers });
  }

  /**
   * Adds a confirmation with buttons, for what has no key on a touch screen.
   *
   * @param isOver when nothing of it can be done any more; until then it stays in the line, unless it hides a message
   */
  confirm(text: string, offers: Offer | readonly Offer[], isOver?: IsOver): void {
    this.given++;
    this.offers = 'run' in offers ? [offers] : offers;
    this.lasts = isOver !== undefined && !this.all.some((m) => m.unread);
    this.passingIsOver = isOver;
    // Said again, it has another button.
    this.passing.set(undefined);
    this.passing.set(text);
  }

  /**
   * Adds an info with buttons: listed, since it is of use later too, and shown briefly, unless a worse one is there, or
   * another one with buttons that is still to be read.
   */
  suggest(text: string, offers: readonly Offer[], isOver: IsOver): void {
    this.given++;
    this.add({ text, severity: 'info', diagnostics: [], offers }, false);
    const isTaken = this.passing.get() !== undefined && this.offers.length > 0 && this.passingIsOver?.() !== true;
    if (isTaken || this.all.some((m) => m.unread)) return;
    this.offers = offers;
    this.lasts = false;
    this.passingIsOver = isOver;
    this.passing.set(undefined);
    this.passing.set(text);
  }

  /** Removes a message with that text: it was dealt with. */
  withdraw(text: string): void {
    if (this.passing.get() === text) this.passing.set(undefined);
    this.keep((m) => m.text !== cutMessage(text));
  }

  /** Messages given so far, passing ones too. */
  get count(): number {
    return this.given;
  }

  /** A marker to tell earlier messages from later ones. */
  get said(): Said {
    return { lastId: this.nextId - 1, passing: this.passing.get() };
  }

  /** After a step: earlier refusals and confirmations aren't about it. Refusals stay listed. */
  leaveBehind({ lastId, passing }: Said): void {
    if (passing !== undefined && this.passing.get() === passing) this.passing.set(undefined);
    this.leaveLine((m) => m.isRefusal === true && m.id <= lastId);
  }

  /** Removes from the line what is over. */
  leaveOver(): void {
    if (this.passing.get() !== undefined && this.passingIsOver?.()) this.passing.set(undefined);
    this.leaveLine((m) => m.isOver?.() === true);
  }

  /** Removes unread messages from the line; they stay in the list. */
  leaveLine(isLeft: (message: Message) => boolean): void {
    const leaves = (m: Message) => m.unread && isLeft(m);
    if (this.all.some(leaves)) this.show(this.all.map((m) => (leaves(m) ? { ...m, unread: false } : m)));
  }

  /**
   * Removes problems that are over, or brings back those that no longer are.
   *
   * @param isSettled asked again about all problems with each call, and about new ones until the next
   */
  settle(isSettled: (problem: Diagnostic) => boolean): void {
    this.isSettled = isSettled;
    this.show(this.all);
  }

  /**
   * Problems of one opening, grouped by file, the worst last and so the newest. Infos alone are listed without a line.
   * Earlier messages about the same files are removed, and those about others leave the line, which is about the last
   * opening; the list keeps them.
   *
   * @param files names of all opened files: those without problems lose their messages too
   * @param fateOf what happened to a file with errors or warnings, in a few words: `not opened`
   */
  report(
    diagnostics: readonly Diagnostic[],
    files: readonly string[] = [],
    fateOf?: (file: string, found: readonly Diagnostic[]) => string | undefined,
  ): void {
    this.given++;
    const well = new Set(files);
    this.forget(well);
    const groups = [...groupByFile(diagnostics)].map(([file, found]) => {
      const severity = worst(found);
      return { file, found, severity, fate: severity !== 'info' && file !== '' ? fateOf?.(file, found) : undefined };
    });
    if (groups.some((g) => g.severity !== 'info')) this.markAllRead();
    for (const severity of RISING) {
      const own = groups.filter((g) => g.severity === severity);
      if (own.length > MAX_APART) this.add(foldedMessage(own, severity), severity !== 'info');
      else {
        for (const { file, found, fate } of own) {
          const message = { text: summary(file, found, fate), severity, diagnostics: found, ...(fate && { fate }) };
          this.add(message, severity !== 'info');
        }
      }
    }
  }

  /** Requests to show the list. */
  askForList(): void {
    this.listAsked.update((times) => times + 1);
  }

  /** Removes a message from the list: it was dealt with. */
  dismiss(id: number): void {
    this.keep((m) => m.id !== id);
  }

  dismissAll(): void {
    this.keep(() => false);
  }

  /** Removes a message from the line; it stays in the list. */
  markRead(id: number): void {
    this.leaveLine((m) => m.id === id);
  }

  markAllRead(): void {
    this.leaveLine(() => true);
  }

  private add(given: Omit<Message, 'id' | 'unread'>, unread = true): void {
    const message = { ...given, text: cutMessage(given.text) };
    const id = this.nextId++;
    if (unread) this.passing.set(undefined);
    // A new refusal replaces an earlier one in the line.
    const isLeft = (m: Message) => message.isRefusal === true && m.isRefusal === true && m.unread;
    const others = this.all.map((m) => (isLeft(m) ? { ...m, unread: false } : m));
    // The same notice isn't repeated, and a file that is read again replaces its message.
    this.show([...others.filter((m) => !isAbout(m, message)), { ...message, id, unread }]);
  }

  /** Removes what was said about these files. */
  private forget(files: ReadonlySet<string>): void {
    this.show(this.all.flatMap((m) => without(m, ({ file }) => files.has(file))));
  }

  private keep(wanted: (message: Message) => boolean): void {
    this.show(this.all.filter(wanted));
  }

  private show(all: readonly Message[]): void {
    this.all = all;
    const before = this.list.get();
    const list = all
      .flatMap((m) => without(m, this.isSettled))
      .map((m, i) => (isShownAs(m, before[i]) ? before[i] : m));
    if (list.length !== before.length || list.some((m, i) => m !== before[i])) this.list.set(list);
  }
}

/** Whether a message that lost some problems was shown like this before. */
function isShownAs({ id, text, unread }: Message, before: Message | undefined): boolean {
  return before?.id === id && before.text === text && before.unread === unread;
}

/** A message without some of its problems; none if nothing is left of it, the same object if it has none of them. */
function without(message: Message, isGone: (problem: Diagnostic) => boolean): readonly Message[] {
  const { diagnostics, fate } = message;
  const left = diagnostics.filter((problem) => !isGone(problem));
  if (left.length === diagnostics.length) return [message];
  return left.length > 0 ? [{ ...message, ...messageAbout(left, fate) }] : [];
}

/** A point in the sequence of messages. */
export interface Said {
  readonly lastId: number;
  readonly passing: string | undefined;
}

const RISING: readonly Severity[] = ['info', 'warning', 'error'];

/** Whether two messages are about the same file, or are the same notice. */
function isAbout(a: Omit<Message, 'id' | 'unread'>, b: Omit<Message, 'id' | 'unread'>): boolean {
  if (a.diagnostics.length === 0 || b.diagnostics.length === 0) {
    return a.diagnostics.length === b.diagnostics.length && a.text === b.text;
  }
  return a.diagnostics[0].file === b.diagnostics[0].file;
}

/** Files of one opening that have messages of their own, of one severity; more are one message. */
const MAX_APART = 20;

interface FileProblems {
  readonly file: string;
  readonly found: readonly Diagnostic[];
  readonly fate: string | undefined;
}

/** `1000 files: not opened. First, a.skel:3: Expected a number, found "x".` */
function foldedMessage(all: readonly FileProblems[], severity: Severity): Omit<Message, 'id' | 'unread'> {
  const [{ file, found, fate }] = all;
  const isSame = all.every((one) => one.fate === fate);
  const shared = isSame && fate ? { fate } : {};
  const first = summary(file, found, undefined);
  const text = `${all.length} files${isSame && fate ? `: ${fate}` : ''}. The first: ${first}`;
  return { text, severity, diagnostics: all.flatMap((one) => one.found), ...shared };
}

/** Of what is left of several files' problems. */
function messageAbout(diagnostics: readonly Diagnostic[], fate: string | undefined) {
  const severity = worst(diagnostics);
  const all = [...groupByFile(diagnostics)].map(([file, found]) => ({ file, found, fate }));
  return all.length > 1
    ? foldedMessage(all, severity)
    : { text: summary(all[0].file, all[0].found, fate), severity, diagnostics };
}

export function groupByFile(diagnostics: readonly Diagnostic[]): Map<string, Diagnostic[]> {
  const groups = new Map<string, Diagnostic[]>();
  for (const diagnostic of diagnostics) {
    const group = groups.get(diagnostic.file);
    if (group) group.push(diagnostic);
    else groups.set(diagnostic.file, [diagnostic]);
  }
  return groups;
}

export function worst(diagnostics: readonly Diagnostic[]): Severity {
  if (diagnostics.some((d) => d.severity === 'error')) return 'error';
  return diagnostics.some((d) => d.severity === 'warning') ? 'warning' : 'info';
}

/** The first of the worst ones, which the text of their message tells; undefined if there are none. */
export function mainProblem(diagnostics: readonly Diagnostic[]): Diagnostic | undefined {
  const severity = worst(diagnostics);
  return diagnostics.find((d) => d.severity === severity);
}

/** `wasp.skel:12: not opened, 2 errors, 1 warning. Expected a number, found "x".` */
function summary(file: string, diagnostics: readonly Diagnostic[], fate: string | undefined): string {
  const first = mainProblem(diagnostics) ?? diagnostics[0];
  const name = file === '' ? '' : `${file}${first.line > 0 ? `:${first.line}` : ''}: `;
  const head = [fate ?? '', diagnostics.length > 1 ? counts(diagnostics) : ''].filter(Boolean).join(', ');
  return `${name}${head && `${head}. `}${first.message}`;
}

/** `2 errors, 1 warning`. */
export function counts(diagnostics: readonly Diagnostic[]): string {
  const parts: string[] = [];
  for (const severity of ['error', 'warning', 'info'] as const) {
    const count = diagnostics.filter((d) => d.severity === severity).length;
    if (count) parts.push(`${count} ${severity === 'info' ? 'note' : severity}${count === 1 ? '' : 's'}`);
  }
  return parts.join(', ');
}

/** A diagnostic as text, in a compiler's format, for copying into a mail. */
export function diagnosticText(d: Diagnostic): string {
  const lines = [`${placeOf(d)}${d.severity} ${d.code}: ${d.message}${d.assumed ? ` (${d.assumed})` : ''}`];
  if (d.excerpt) lines.push(`  ${d.excerpt.text}`, `  ${caretPad(d.excerpt.text, d.excerpt.caret)}^`);
  return lines.join('\n');
}

/** All of them, for a mail or an issue. */
export function messagesText(messages: readonly Message[]): string {
  const linesOf = ({ diagnostics, severity, text }: Message) =>
    diagnostics.length ? diagnostics.map(diagnosticText) : [`${severity}: ${text}`];
  return messages.flatMap(linesOf).join('\n');
}

/** `wasp.skel:3:11: `, as far as known. */
function placeOf(d: Diagnostic): string {
  if (d.file === '') return '';
  return d.line > 0 ? `${d.file}:${d.line}:${d.column}: ` : `${d.file}: `;
}

/** Whitespace as wide as the text before the caret: tabs stay tabs. */
export function caretPad(text: string, caret: number): string {
  return text.slice(0, Math.max(0, caret)).replace(/[^\t]/g, ' ');
}
