/* The caller's options, checked and with nothing left open. */
#ifndef SNOW_BASE_OPTIONS_H
#define SNOW_BASE_OPTIONS_H

#include <snowgrowth/options.h>

/* `settled` gets the defaults where the caller (who may be NULL) set nothing;
   threads is then at least 1, and isa is one that is available. */
snow_status snow_options_settle(const snow_options *caller, snow_options *settled);

#endif
