// A live page.
