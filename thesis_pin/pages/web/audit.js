// Which equations of the audit are shown: by verdict, and by what they contain; what uses a line.
const rows = [...document.querySelectorAll('article')];
const find = document.getElementById('find'), shown = document.getElementById('shown');
const boxes = [...document.querySelectorAll('.filters input[type=checkbox]')];
const GREEK = { alpha: 'α', beta: 'β', gamma: 'γ', delta: 'δ', theta: 'θ', lambda: 'λ', tau: 'τ', phi: 'φ', varphi: 'φ', psi: 'ψ', omega: 'ω' };
// θ̇_{21}, \dot{\theta}_{21} and theta21 are the same to a reader who searches.
function plain(text) {
  return text.replace(/[˙¨]|\\d?dot|\\(math|bold)[a-z]+/g, '').normalize('NFKD').toLowerCase()
    .replace(/[\u0300-\u036f_^{}\\]/g, '')
    .replace(/alpha|beta|gamma|delta|theta|lambda|tau|varphi|phi|psi|omega/g, (name) => GREEK[name]);
}
const texts = new Map();
function contains(row, words) {
  if (!texts.has(row)) texts.set(row, plain(`${row.id} ${row.textContent}`));
  return words.every((word) => texts.get(row).includes(word));
}
function filter() {
  const wanted = new Set(boxes.filter((box) => box.checked).map((box) => box.value.replace(' ', '-')));
  const words = plain(find.value).split(/\s+/).filter(Boolean);
  let count = 0;
  for (const row of rows) {
    row.hidden = !(wanted.has(row.classList[0]) && contains(row, words));
    count += !row.hidden;
  }
  shown.textContent = count;
  for (const group of document.querySelectorAll('.group')) group.hidden = !group.querySelector('article:not([hidden])');
}
find.oninput = filter;
for (const box of boxes) box.onchange = filter;
for (const button of document.querySelectorAll('.card button')) {
  button.onclick = () => {
    find.value = button.dataset.find;
    filter();
    document.getElementById('equations').scrollIntoView();
  };
}
// A link leads to its line whatever is filtered away.
function follow() {
  const row = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!row?.hidden) return;
  find.value = '';
  for (const box of boxes) box.checked = true;
  filter();
  row.scrollIntoView();
}
addEventListener('hashchange', follow);
// The page names what a line uses; here the names become links, and the other way round.
const robot = rows[0]?.id.split(':')[0];
const users = new Map();
const MANY = 12;  // names that a line shows without being asked
function line(label, names) {
  const box = document.createElement(names.length > MANY ? 'details' : 'p');
  const head = names.length > MANY ? document.createElement('summary') : box;
  if (head !== box) box.append(head);
  box.className = 'links';
  head.append(`${label} `);
  for (const name of names) {
    const one = document.createElement('a');
    one.href = `#${robot}:${name}`;
    one.textContent = name;
    box.append(one, ' ');
  }
  return box;
}
for (const head of document.querySelectorAll('article h4')) {
  const one = document.createElement('a');
  one.href = `#${head.parentElement.id}`;
  one.append(head.firstChild);
  head.prepend(one);
}
for (const written of document.querySelectorAll('article > .links')) {
  const names = written.textContent.trim().split(/\s+/).slice(1), id = written.parentElement.id;
  for (const name of names) users.set(name, [...users.get(name) ?? [], id.slice(robot.length + 1)]);
  written.replaceWith(line(names.length > MANY ? `uses ${names.length}` : 'uses', names));
}
for (const [name, found] of users) {
  document.getElementById(`${robot}:${name}`).append(line(`used by ${found.length}:`, found));
}
