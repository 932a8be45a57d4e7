// Which equations of the audit are shown: by verdict, and by what they contain.
const rows = [...document.querySelectorAll('article')];
const find = document.getElementById('find'), shown = document.getElementById('shown');
const boxes = [...document.querySelectorAll('.filters input[type=checkbox]')];
function filter() {
  const wanted = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
  const text = find.value.toLowerCase();
  let count = 0;
  for (const row of rows) {
    const fits = wanted.has(row.dataset.verdict) && row.dataset.text.includes(text);
    row.hidden = !fits;
    count += fits;
  }
  shown.textContent = count;
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
filter();
