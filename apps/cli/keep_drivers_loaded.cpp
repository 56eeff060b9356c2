// Linked under the leak sanitizer alone: graphics drivers stay in memory until the process has ended, so that
// its report can name the driver that a leak belongs to (tests/e2e/driver_leaks.supp).
extern "C" int dlclose(void*) {
  return 0;
}
