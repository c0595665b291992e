/**
 * Evaluates typed expressions:
 *
 *     sum     = product { ("+" | "-") product }
 *     product = signed { ("*" | "/") signed }
 *     signed  = [ "+" | "-" ] amount
 *     amount  = ( number | "pi" | "(" sum ")" ) [ unit ]
 *
 * A plain number is read exactly as JavaScript reads it. A unit is a factor to the field's unit.
 */

/** Unit names in lower case, with their factors to the field's unit. */
export type Units = Readonly<Record<string, number>>;

const DEGREES = 180 / Math.PI;
/** Of fields that show degrees, and radians. */
export const IN_DEGREES: Units = { deg: 1, '°': 1, rad: DEGREES };
export const IN_RADIANS: Units = { deg: 1 / DEGREES, '°': 1 / DEGREES, rad: 1 };

/** The units of a field by the text after it: `°`, `rad`, `s`, `cm`. */
export function unitsBehind(words: string): Units {
  if (words === '°') return IN_DEGREES;
  return words === 'rad' ? IN_RADIANS : { [words.toLowerCase()]: 1 };
}

const NUMBER = /^(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?/i;
const WORD = /^(?:[°π]|[a-z]+)/i;
const PI: Readonly<Record<string, number>> = { pi: Math.PI, π: Math.PI };
/** Maximum length: a paste of a million parentheses is not a number. */
const LONGEST = 200;

/** The value of the text; undefined if it doesn't follow the grammar or isn't finite. */
export function workedOut(text: string, units: Units): number | undefined {
  if (text.length > LONGEST) return undefined;
  const reader = new Reader(text.replaceAll('−', '-').replaceAll('×', '*').replaceAll('÷', '/'), units);
  const value = reader.sum();
  return reader.isAtEnd && Number.isFinite(value) ? value : undefined;
}

/** Errors are NaN, which propagates through all operations. */
class Reader {
  private at = 0;

  constructor(
    private readonly text: string,
    private readonly units: Units,
  ) {}

  get isAtEnd(): boolean {
    this.skipBlanks();
    return this.at === this.text.length;
  }

  sum(): number {
    let value = this.product();
    for (;;) {
      if (this.take('+')) value += this.product();
      else if (this.take('-')) value -= this.product();
      else return value;
    }
  }

  private product(): number {
    let value = this.signed();
    for (;;) {
      if (this.take('*')) value *= this.signed();
      else if (this.take('/')) value /= this.signed();
      else return value;
    }
  }

  private signed(): number {
    if (this.take('-')) return -this.amount();
    this.take('+');
    return this.amount();
  }

  private amount(): number {
    const value = this.bare();
    const unit = this.lookAt(WORD);
    const factor = own(this.units, unit);
    if (factor === undefined) return value;
    this.at += unit.length;
    return value * factor;
  }

  private bare(): number {
    if (this.take('(')) {
      const value = this.sum();
      return this.take(')') ? value : Number.NaN;
    }
    const digits = this.lookAt(NUMBER);
    if (digits) {
      this.at += digits.length;
      return Number(digits.replace(',', '.'));
    }
    const word = this.lookAt(WORD);
    this.at += word.length;
    return own(PI, word) ?? Number.NaN;
  }

  /** Matches a pattern at the current position; empty if it doesn't match. */
  private lookAt(form: RegExp): string {
    this.skipBlanks();
    return form.exec(this.text.slice(this.at))?.[0] ?? '';
  }

  private take(sign: string): boolean {
    this.skipBlanks();
    if (this.text[this.at] !== sign) return false;
    this.at++;
    return true;
  }

  private skipBlanks(): void {
    while (/\s/.test(this.text.charAt(this.at))) this.at++;
  }
}

function own(words: Units, word: string): number | undefined {
  const name = word.toLowerCase();
  return Object.hasOwn(words, name) ? words[name] : undefined;
}
