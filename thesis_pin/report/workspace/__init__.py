"""A robot's workspace as a document, a table, figures and a page."""
