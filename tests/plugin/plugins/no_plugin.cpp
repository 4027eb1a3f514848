// A shared library that is no plug-in, and needs a function that is defined nowhere where MISSING says so.
#ifdef MISSING
int missingFunction();
int needsIt() { return missingFunction(); }
#else
int nothing() { return 0; }
#endif
