// Answers of what looks into the system.
#ifndef BTR_OPENR_ANALYZERERROR_H
#define BTR_OPENR_ANALYZERERROR_H

typedef int AnalyzerError;
const AnalyzerError azrSUCCESS = 0;
const AnalyzerError azrFAIL = 1;

#endif
