/** Mistakes in skinning, morphs and normals. */
import { finer, inSkin, type Mistake } from './mistake.ts';

/** Treatments of an attachment to a joint that is not there. */
const BEYOND = [
  ['clamped', 'indices out of range use the last joint'],
  ['wrapped', 'indices out of range wrap around'],
  ['left out', 'indices out of range are ignored'],
] as const;
const SKINNING_FORMULA = 'v′ = Σ wᵢ·Wᵢ·Bᵢ⁻¹·v';

/** All known mistakes in skinning, morphs and normals, each with its variants. */
export const SKINNING: readonly Mistake[] = [
  {
    code: 'no-inverse-binding',
    subject: 'skinning',
    sentence: () => 'You multiply vertices by W alone; it should be W·B⁻¹.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('W', { binding: 'none' })],
  },
  {
    code: 'binding-not-inverted',
    subject: 'skinning',
    sentence: () => 'You multiply vertices by W·B; it should be W·B⁻¹, with the binding matrix inverted.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('W·B', { binding: 'not inverted' })],
  },
  {
    code: 'binding-order',
    subject: 'skinning',
    sentence: () => 'You multiply vertices by B⁻¹·W; it should be W·B⁻¹.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('B⁻¹·W', { binding: 'before world' })],
  },
  {
    code: 'binding-rows',
    subject: 'skinning',
    sentence: () =>
      'You read binding matrices by rows. Each line of the file should be a column: a, b, c and the position d.',
    formula: 'B = (a b c d), each a column',
    variants: [inSkin('B transposed', { bindingRows: true })],
  },
  {
    code: 'first-attachment-only',
    subject: 'skinning',
    sentence: (detail) => `You use only one attachment per vertex (${detail}). All of them should move it.`,
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('the first, with its own weight', { attachments: 'first' }),
      inSkin('the first, with weight 1', { attachments: 'first as whole' }),
      inSkin('the one with the largest weight, which it keeps', { attachments: 'largest' }),
      inSkin('the one with the largest weight, as weight 1', { attachments: 'largest as whole' }),
    ],
  },
  {
    code: 'first-four-attachments',
    subject: 'skinning',
    sentence: (detail) =>
      `You use only four attachments per vertex (${detail}). All of them should be used; a vertex may have any number.`,
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('the first four, their weights not rescaled', { attachments: 'first four' }),
      inSkin('the first four, their weights rescaled to sum to 1', { attachments: 'first four normalised' }),
      finer(
        inSkin('the first four, their weights rescaled to sum to 1 only where others are left out', {
          attachments: 'first four, cut ones normalised',
        }),
      ),
      inSkin('the four largest, their weights not rescaled', { attachments: 'largest four' }),
      inSkin('the four largest, their weights rescaled to sum to 1', { attachments: 'largest four normalised' }),
    ],
  },
  {
    code: 'weights-normalised',
    subject: 'skinning',
    sentence: () => 'You normalise the weights. They should be used as the file gives them.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('w / Σ w', { weights: 'normalised' })],
  },
  {
    code: 'bind-pose',
    subject: 'skinning',
    sentence: () => "You don't move the skin: these are the vertices of the file. They should be skinned.",
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('with morphs', { bind: 'bind pose' }),
      finer(inSkin('without morphs', { bind: 'bind pose without morphs' })),
    ],
  },
  {
    code: 'morph-as-offset',
    subject: 'skinning',
    sentence: () =>
      'You add the values of morphs. They are absolute, so their difference from the base should be added.',
    formula: 'v = v₀ + Σ φₜ·(vₜ − v₀)',
    variants: [inSkin('v₀ + Σ φₜ·vₜ', { morph: 'offset' })],
  },
  {
    code: 'morph-after-skinning',
    subject: 'skinning',
    sentence: () => 'You add morphs after skinning. They should change the base skin before it is skinned.',
    formula: 'v = v₀ + Σ φₜ·(vₜ − v₀), then v′ = Σ wᵢ·Wᵢ·Bᵢ⁻¹·v',
    variants: [
      inSkin('', { morph: 'after' }),
      finer(inSkin('normals too, after normalising', { morph: 'after normalising' })),
      finer(inSkin('positions only', { morph: 'after, positions only' })),
    ],
  },
  {
    code: 'normals-by-position-matrix',
    subject: 'skinning',
    sentence: () =>
      'You transform normals by the whole matrix. A direction has no position, so the translation should be left out.',
    formula: 'n′ = Σ wᵢ·(Wᵢ·Bᵢ⁻¹)⁻ᵀ·n, normalised',
    variants: [
      inSkin('M·(n, 1)', { normals: 'as positions' }),
      inSkin('M⁻ᵀ·n with the translation', { normals: 'with translation' }),
    ],
  },
  {
    code: 'normals-unnormalised',
    subject: 'skinning',
    sentence: () => "You don't normalise normals. They should have length 1 after skinning.",
    formula: 'n′ / |n′|',
    variants: [inSkin('', { isNormalised: false })],
  },
  {
    code: 'normals-without-transpose',
    subject: 'skinning',
    sentence: (detail) => `You multiply normals by ${detail}; it should be the inverse transpose.`,
    formula: 'n′ = Σ wᵢ·(Wᵢ·Bᵢ⁻¹)⁻ᵀ·n, normalised',
    variants: [inSkin('M', { normals: 'matrix' }), inSkin('M⁻¹', { normals: 'inverse' })],
  },
  {
    code: 'joint-index-off',
    subject: 'skinning',
    sentence: (detail) => `Your attachments' joint indices are off by one (${detail}). They should start at 0.`,
    formula: 'joint 0 is the root',
    variants: [1, -1].flatMap((shift) =>
      BEYOND.map(([beyond, detail], i) => {
        const variant = inSkin(`${shift > 0 ? '+1' : '−1'}, ${detail}`, { joint: { shift, beyond } });
        return i > 0 ? finer(variant) : variant;
      }),
    ),
  },
];
