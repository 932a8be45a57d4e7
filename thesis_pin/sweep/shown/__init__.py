"""A sweep as tables, a document, figures and a page."""
