/**
 * Commands: named changes to the document. Each is one record, and its file the only one that knows it:
 *
 *     export const setClamping = command({
 *       id: 'pose.setClamping',
 *       args: { characterId: text, clamps: boolean },
 *       label: (document, { characterId, clamps }) => …,
 *       run: (document, { characterId, clamps }) => …,
 *     });
 *
 * What its arguments are is said once, by shapes (`schema/shape.ts`): from them come their types, their check, and the
 * words of `marrow.commands()`. `label` and `run` are given arguments of that shape. What depends on the document, such
 * as how many joints there are, they check themselves.
 */
import type { Document } from '../model/document.ts';
import type { Change } from './change.ts';
import { type Fields, type Given, record, type Shapes } from './schema/shape.ts';

/** Menu entry, undo entry and scripted call in one. */
export interface Command<Args, Result extends Document | Change = Document> {
  /** Stable: `pose.setDof`. */
  readonly id: string;
  /** Label in the Edit menu: "Set rx". */
  label(document: Document, args: Args): string;
  /** No undo step: it changes what is edited, and nothing that is saved. */
  readonly isNoStep?: true;
  /** The changed document; the same object if nothing changes. Throws a `CommandError` to refuse. */
  run(document: Document, args: Args): Result;
}

/** How a command of the document is declared. */
export interface Declared<F extends Fields, Result extends Document | Change> {
  readonly id: string;
  /** Shape of each argument, by name. */
  readonly args: F;
  /** Creates a character, so that none has to be named. */
  readonly makesCharacter?: true;
  /** Why scripts can't run it, and what they can run: `it takes whole characters. Run "compare.stop"`. */
  readonly notFromScripts?: string;
  /** See `Command`. */
  readonly isNoStep?: true;
  label(document: Document, args: Given<F>): string;
  run(document: Document, args: Shapes<F>): Result;
}

/** A command of the document. Its `run` checks its arguments, whoever gives them. */
export interface DocumentCommand<Args, Result extends Document | Change = Document>
  extends Command<Args, Result>,
    Pick<Declared<Fields, Result>, 'args' | 'makesCharacter' | 'notFromScripts'> {
  /**
   * A copy of arguments of any kind, as plain data, for scripts.
   * @throws CommandError naming the argument that doesn't fit, or isn't known
   */
  read(given: unknown): Args;
  /** As `run`, for arguments that `read` has returned. */
  runRead(document: Document, args: Args): Result;
}

/** Any command of the document, whatever it takes. */
export type AnyCommand = Omit<DocumentCommand<never, Document | Change>, 'read'> & { read(given: unknown): object };

/** The arguments of a command. */
export type ArgsOf<C> = C extends Command<infer Args, infer _Result> ? Args : never;

/**
 * Makes a command of its record. Its `read` copies and checks arguments from scripts; its `run` checks them too.
 * @throws CommandError from `read` and `run` for arguments of another shape, and whatever the record's own `run` throws
 */
export function command<const F extends Fields, Result extends Document | Change = Document>(
  declared: Declared<F, Result>,
): DocumentCommand<Given<F>, Result> {
  const shape = record(declared.args);
  return {
    ...declared,
    read: (given) => shape.read(given, ''),
    run: (document, args) => declared.run(document, shape.read(args, '', 'left out')),
    runRead: declared.run,
  };
}
