"""The protocol of a test programme: a page, a PDF, a table, in English and German."""
