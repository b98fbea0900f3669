// The colours of the stage and of the plots, in the light and the dark theme.

export const BODIES = ['#3f87bd', '#e08a3c', '#57a873', '#b56ba3', '#c9ac3f', '#7689a6'];
export const OBSTACLE = '#a9a196';
export const CHOSEN = '#e0485f';

const dark = window.matchMedia('(prefers-color-scheme: dark)');

/** Calls `change` whenever the theme changes between light and dark. */
export function onPalette(change) {
    dark.addEventListener('change', change);
}

/** Returns a colour of style.css by its name, such as `ink`. */
export function paletteColor(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
