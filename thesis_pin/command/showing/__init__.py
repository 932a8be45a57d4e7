"""Where the verb ``view`` can show a scene besides the browser's own page."""
