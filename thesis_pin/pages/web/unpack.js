"use strict";
// Content of a <script type="text/plain"> that holds base64 of gzip.
async function unpack(id) {
  const text = document.getElementById(id).textContent.trim();
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function loadLibrary(id) {
  const script = document.createElement("script");
  script.textContent = new TextDecoder().decode(await unpack(id));
  document.head.append(script);
}

// Say in the page what went wrong: nobody looks into the console.
function complain(element, error) {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.className = "alert";
  note.textContent =
    typeof DecompressionStream === "undefined"
      ? "This page needs a browser of 2023 or later (it unpacks itself with DecompressionStream)."
      : `The animation can't be shown: ${error.message || error}`;
  element.replaceChildren(note);
  console.error(error);
}
