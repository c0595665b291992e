/** Extensions of images: apart from their reader, since the page's first script needs only these. */

/** Without dots. */
export const TEXTURE_EXTENSIONS = ['bmp', 'png', 'jpg', 'jpeg', 'webp'] as const;
