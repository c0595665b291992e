/**
 * `.rig`: which files belong together.
 *
 *     rig  = "rig" NAME "{" { part } "}"
 *     part = skeleton FILE | skin FILE | morphs N "{" { FILE } "}" | animation FILE        each optional, in any order
 */
import type { Rig } from '../../model/rig.ts';
import {
  braceTooMany,
  checkCount,
  countAndBrace,
  type GrammarPart,
  namedHead,
  skipStrange,
  stemOfName,
  warnRepeated,
} from '../grammar.ts';
import { WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { Tokens } from '../tokens.ts';

/** A reader for a `.rig`. */
export function rigReader(fileName: string): Reader<Rig> {
  return grammarReader(fileName, rigFile);
}

/** Reads a whole `.rig`. */
export function readRig(bytes: Uint8Array | string, fileName: string): ReadResult<Rig> {
  return readWhole(rigReader(fileName), bytes);
}

/** Extensions of the FILE of each part, at which a name with blanks ends. */
const RIG_EXTENSIONS = {
  skeleton: /\.(skel|axskel)$/i,
  skin: /\.skin$/i,
  morphs: /\.morph$/i,
  animation: /\.anim$/i,
} as const;

const RIG = new Set(['rig']);
const KEYWORDS = new Set(Object.keys(RIG_EXTENSIONS));

interface Parts {
  skeleton?: string;
  skin?: string;
  morphs?: string[];
  animation?: string;
}

function* rigFile(t: Tokens): GrammarPart<Rig | undefined> {
  let rig: Rig | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    if (kind === '}') braceTooMany(t);
    else if (t.keyword() === 'rig') {
      if (rig) warnRepeated(t, 'rig');
      rig = yield* body(t);
    } else yield* skipStrange(t, 'a .rig file', 'rig', RIG);
  }
  if (!rig) t.report.error('rig-missing', 'Expected rig NAME { … }, found none.', WHOLE_FILE);
  return rig;
}

function* body(t: Tokens): GrammarPart<Rig> {
  const opened = t.mark();
  const name = (yield* namedHead(t, 'rig', 0, KEYWORDS)) || stemOfName(t.fileName);
  const parts: Parts = {};
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the rig');
    const word = t.keyword();
    if (word === 'skeleton' || word === 'skin' || word === 'animation') {
      if (parts[word] !== undefined) warnRepeated(t, word);
      const file = yield* fileOf(t, word);
      if (file !== undefined) parts[word] = file;
    } else if (word === 'morphs') {
      if (parts.morphs) warnRepeated(t, word);
      parts.morphs = yield* morphs(t);
    } else yield* skipStrange(t, 'a rig', 'skeleton, skin, morphs or animation');
  }
  return { name, morphs: [], ...parts };
}

function* fileOf(t: Tokens, part: 'skeleton' | 'skin' | 'animation'): GrammarPart<string | undefined> {
  const kind = yield* t.next();
  if (kind === 'word' && !(t.startsLine && KEYWORDS.has(t.keyword()))) {
    return yield* t.file(RIG_EXTENSIONS[part], KEYWORDS);
  }
  t.error('file-expected', `Expected a file name after ${part}, found ${t.found()}.`);
  t.again();
  return undefined;
}

/** `N { FILE … }` */
function* morphs(t: Tokens): GrammarPart<string[]> {
  const opened = t.mark();
  const declared = yield* countAndBrace(t, 'morphs', KEYWORDS);
  const files: string[] = [];
  for (;;) {
    const kind = yield* t.next();
    if (kind === '}') break;
    if (kind === 'end') t.failAtEnd(opened, 'the morphs');
    if (kind === '{') yield* skipStrange(t, 'the morphs', 'a file name');
    else files.push(yield* t.file(RIG_EXTENSIONS.morphs, NONE));
  }
  checkCount(t, 'morphs', declared, files.length);
  return files;
}

const NONE: ReadonlySet<string> = new Set();
