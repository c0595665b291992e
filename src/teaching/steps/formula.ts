/** A formula as text whose symbols know what they stand for, so that a page can point at it. */

/** The meaning of a symbol. */
export type Meaning =
  | { readonly kind: 'joint'; readonly joint: number }
  /** Into the character's DOFs (`model/dofs.ts`). */
  | { readonly kind: 'dof'; readonly dof: number };

/** A part of a formula that stands for something. */
export interface FormulaSymbol {
  readonly text: string;
  readonly means: Meaning;
}

/** From left to right. */
export type Formula = readonly (string | FormulaSymbol)[];

/** A letter with the joint's index as subscript: `L₇`. */
export function jointSymbol(letter: string, joint: number): FormulaSymbol {
  return { text: `${letter}${subscript(joint)}`, means: { kind: 'joint', joint } };
}

/** A text that stands for a DOF, by its index in the character's list. */
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
