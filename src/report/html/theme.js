// Colours of the drawing, dark and light; the page's own are in the style sheet.

const THEMES = {
  dark: {
    ground: '#0d1016', board: '#1c222b', copper: '#d99652', cut: '#f6f1e3', hole: '#06070a', rim: '#8aa0b8', rapid: '#ff5d8f',
    path: '#5ad1c5', clad: '#b97a3f', lost: '#ff3b30', ink: '#e8edf4', plate: '#0d1016d0', glow: '#ffffff', tool: '#4cc2ff',
    info: '#7fb2ff', warning: '#ffb020', error: '#ff4d4d', tint: hue => `hsl(${hue} 34% 27%)`, vivid: hue => `hsl(${hue} 70% 62%)`,
  },
  light: {
    ground: '#f3f1ec', board: '#dfe3e2', copper: '#c4783a', cut: '#2b3441', hole: '#ffffff', rim: '#4a6078', rapid: '#d6226a',
    path: '#00857a', clad: '#c98a4e', lost: '#e0001b', ink: '#1a212b', plate: '#fffdf8d8', glow: '#000000', tool: '#0067c0',
    info: '#2467c9', warning: '#a35c00', error: '#c8102e', tint: hue => `hsl(${hue} 38% 84%)`, vivid: hue => `hsl(${hue} 62% 42%)`,
  },
};

const prefersDark = matchMedia('(prefers-color-scheme: dark)');
const prefersStill = matchMedia('(prefers-reduced-motion: reduce)');

let theme = THEMES.dark;
let themeName = '';

// 'light', 'dark', or '' for what the system says.
function applyTheme(name = themeName) {
  themeName = name;
  const shown = name || (prefersDark.matches ? 'dark' : 'light');
  document.documentElement.dataset.theme = shown;
  theme = THEMES[shown];
}

// How free a cut is to move, from the copper it would cut (no room) to a millimetre and more: the stops of the scale.
const CLEARANCE = [
  { upTo: 0, colour: '#ff2d55', text: 'none: it cuts copper' },
  { upTo: 25, colour: '#ff7a1a', text: 'below 25 µm' },
  { upTo: 50, colour: '#ffb300', text: 'below 50 µm' },
  { upTo: 100, colour: '#d6d02a', text: 'below 0.1 mm' },
  { upTo: 250, colour: '#5fbf4a', text: 'below 0.25 mm' },
  { upTo: 1000, colour: '#1fa7b5', text: 'below 1 mm' },
  { upTo: Infinity, colour: '#4a72d9', text: '1 mm and more' },
];
const clearanceStop = room => CLEARANCE.findIndex(stop => room < stop.upTo);
