/** Values of tokens in a joint: words out of a few, lists of them, numbers and vectors. */
import type { Vec3 } from '../../math/vec3.ts';
import { type GrammarPart, number, numbers } from '../grammar.ts';
import type { Keywords, Tokens } from '../tokens.ts';

/** One word out of a few; undefined where there is an error, and what stands there is left if it means something else. */
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

/** Words out of a few, each once, up to what is none of them. There may be none at all. */
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

/** Whether the token at hand is no try at a value, but something that comes after it. */
function isOther(t: Tokens, keywords: Keywords): boolean {
  return t.kind !== 'word' || t.startsLine || keywords.has(t.keyword());
}

/** The one number of a token; undefined where it is missing. */
export function numberToken(t: Tokens, token: string, keywords: Keywords): GrammarPart<number | undefined> {
  return number(t, `a number after ${token}`, keywords);
}

/** The x y z of a token; undefined where not all of them are there, which is an error. */
export function* vectorToken(t: Tokens, token: string, keywords: Keywords): GrammarPart<Vec3 | undefined> {
  const errors = t.report.errorCount;
  const [x, y, z] = yield* numbers(t, 3, (i) => `${'xyz'[i]} of ${token}`, keywords);
  return t.report.errorCount === errors ? [x, y, z] : undefined;
}
