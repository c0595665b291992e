/** Values of tokens in a joint: words from a set, lists of them, numbers and vectors. */
import type { Vec3 } from '../../math/vec3.ts';
import { type GrammarPart, number, numbers } from '../grammar.ts';
import type { Keywords, Tokens } from '../tokens.ts';

/** A word from a set; undefined after an error, leaving the token if it means something else. */
export function* oneOfWords<W extends string>(
  t: Tokens,
  token: string,
  words: readonly W[],
  keywords: Keywords,
): GrammarPart<W | undefined> {
  yield* t.next();
  const found = t.keyword();
  const word = words.find((one) => one === found);
  if (word !== undefined) return word;
  t.error(`${token}-unknown`, `Expected one of ${words.join(', ')} after ${token}, found ${t.found()}.`);
  if (isOther(t, keywords)) t.again();
  return undefined;
}

/** Words from a set, each once, up to one that is not in it. May be empty. */
export function* listOfWords<W extends string>(
  t: Tokens,
  token: string,
  words: readonly W[],
  keywords: Keywords,
): GrammarPart<readonly W[]> {
  const list: W[] = [];
  for (;;) {
    yield* t.next();
    const found = t.kind === 'word' ? t.keyword() : '';
    const word = words.find((one) => one === found);
    if (word === undefined) {
      if (isOther(t, keywords)) {
        t.again();
        return list;
      }
      t.error(`${token}-unknown`, `Expected one or more of ${words.join(', ')} after ${token}, found ${t.found()}.`);
    } else if (list.includes(word))
      t.error(`${token}-repeated`, `Expected each of ${token} once, found ${word} again.`);
    else list.push(word);
  }
}

/** Whether the current token is not a misspelt value, but what comes after it. */
function isOther(t: Tokens, keywords: Keywords): boolean {
  return t.kind !== 'word' || t.startsLine || keywords.has(t.keyword());
}

/** A token's single number; undefined if it is missing. */
export function numberToken(t: Tokens, token: string, keywords: Keywords): GrammarPart<number | undefined> {
  return number(t, `a number after ${token}`, keywords);
}

/** A token's x y z; undefined if any is missing, which is an error. */
export function* vectorToken(t: Tokens, token: string, keywords: Keywords): GrammarPart<Vec3 | undefined> {
  const errors = t.report.errorCount;
  const [x, y, z] = yield* numbers(t, 3, (i) => `${'xyz'[i]} of ${token}`, keywords);
  return t.report.errorCount === errors ? [x, y, z] : undefined;
}
