/** A formula as text whose symbols know what they stand for, so that a page can point at it. */

/** What a symbol stands for. */
export type Meaning =
  | { readonly kind: 'joint'; readonly joint: number }
  /** Into the character's DOFs (`model/dofs.ts`). */
  | { readonly kind: 'dof'; readonly dof: number };

export interface FormulaSymbol {
  readonly text: string;
  readonly means: Meaning;
}

/** From left to right. */
export type Formula = readonly (string | FormulaSymbol)[];

export function jointSymbol(letter: string, joint: number): FormulaSymbol {
  return { text: `${letter}${subscript(joint)}`, means: { kind: 'joint', joint } };
}

export function dofSymbol(text: string, dof: number): FormulaSymbol {
  return { text, means: { kind: 'dof', dof } };
}

/** Without what its symbols stand for. */
export function formulaText(formula: Formula): string {
  return formula.map((part) => (typeof part === 'string' ? part : part.text)).join('');
}

const DIGITS = '₀₁₂₃₄₅₆₇₈₉';

/** `7` as `₇`. */
export function subscript(index: number): string {
  return [...String(index)].map((digit) => DIGITS[Number(digit)]).join('');
}
