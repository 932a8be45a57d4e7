"""An accuracy study in words, tables, documents, pictures and pages."""
