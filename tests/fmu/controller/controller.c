/* A PI controller as an FMU for co-simulation, of FMI 2.0 (-DFMI=2) or 3.0 (-DFMI=3), for the tests of the import:

     torque = proportional e + I,  dI/dt = integral e,  e = wanted - speed

   with inputs that last over a communication step. The parameter `fault` makes it fail from `fault_time` on: 1 error,
   2 discard (FMI 2) or the wish to end (FMI 3), 3 an output that is no number, 4 fatal, 5 a warning, 6 a crash. With NO_STATE it cannot save its
   state; with STATES_ARE_RESTORED a step fails whose importer promises to return to none; with NEEDS_SPEED its torque is
   no number before it has a speed. HERSEY_TEST_INTERRUPT names a time at which the process gets an interrupt, as from a keyboard. */
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPEED = 1, WANTED, PROPORTIONAL, INTEGRAL, FAULT_TIME, TORQUE, FAULT, IS_REVERSED, NAME };
enum Status { OK, WARNING, DISCARD, ERROR, FATAL };

typedef struct {
  double speed, wanted, proportional, integral, fault_time, torque, sum, time;
  int fault, is_reversed;
} State;

typedef struct {
  State state;
  void* environment;
#if FMI == 2
  void (*log)(void*, const char*, int, const char*, const char*, ...);
#else
  void (*log)(void*, int, const char*, const char*);
#endif
} Controller;

static void say(Controller* c, int status, const char* text) {
#if FMI == 2
  c->log(c->environment, "controller", status, "logStatusError", "%s (%d)", text, status);
#else
  c->log(c->environment, status, "logStatusError", text);
#endif
}

static double* real(Controller* c, unsigned reference) {
  State* s = &c->state;
  switch (reference) {
    case SPEED: return &s->speed;
    case WANTED: return &s->wanted;
    case PROPORTIONAL: return &s->proportional;
    case INTEGRAL: return &s->integral;
    case FAULT_TIME: return &s->fault_time;
    case TORQUE: return &s->torque;
    default: return NULL;
  }
}

static void* instantiate(const char* token, const char* resources) {
  if (strcmp(token, "controller-of-the-tests") != 0 || resources == NULL) return NULL;
  Controller* c = calloc(1, sizeof *c);
  c->state.proportional = 1;
  c->state.fault_time = 1e300;
  return c;
}

/* speed comes in rpm: the unit of its description */
static double missing(const State* s) {
  return (s->wanted - s->speed * (3.14159265358979323846 / 30)) * (s->is_reversed ? -1 : 1);
}

static void answer(State* s) { s->torque = s->proportional * missing(s) + s->sum; }

static int step(Controller* c, double time, double length, bool no_return) {
  State* s = &c->state;
#ifdef STATES_ARE_RESTORED
  if (no_return) {
    say(c, ERROR, "the importer promises not to return to a saved state");
    return ERROR;
  }
#endif
  (void)no_return;
  if (fabs(time - s->time) > 1e-9) {
    say(c, ERROR, "a step that does not begin where the last one has ended");
    return ERROR;
  }
  int status = OK;
  const char* interrupt = getenv("HERSEY_TEST_INTERRUPT");
  if (interrupt != NULL && fabs(time - atof(interrupt)) < length / 2) raise(SIGINT);
  if (s->fault != 0 && time + length > s->fault_time) {
    if (s->fault == 5) {
      say(c, WARNING, "the fuse is warm");
      status = WARNING;
    } else if (s->fault == 6) {
      abort();
    } else if (s->fault == 3) {
      s->torque = NAN;
      return OK;
    }
    if (status == OK) {
      say(c, s->fault, "the fuse has blown");
      return s->fault == 1 ? ERROR : s->fault == 2 ? DISCARD : FATAL;
    }
  }
  s->sum += s->integral * missing(s) * length;
  s->time = time + length;
  answer(s);
  return status;
}

#define NAMED(version, name) fmi##version##name
#define EXPAND(version, name) NAMED(version, name)
#define F(name) EXPAND(FMI, name)
#define PUBLIC __attribute__((visibility("default")))

typedef unsigned Reference;

PUBLIC void F(FreeInstance)(void* c) { free(c); }
PUBLIC int F(Terminate)(void* c) { return c == NULL ? ERROR : OK; }
PUBLIC int F(ExitInitializationMode)(void* c) {
  answer(&((Controller*)c)->state);
  return OK;
}

static int get(Controller* c, const Reference* references, size_t count, double* values) {
#ifdef NEEDS_SPEED
  c->state.torque += 0 / c->state.speed;
#endif
  for (size_t i = 0; i < count; ++i) {
    if (real(c, references[i]) == NULL) return ERROR;
    values[i] = *real(c, references[i]);
  }
  return OK;
}

static int set(Controller* c, const Reference* references, size_t count, const double* values) {
  for (size_t i = 0; i < count; ++i) {
    if (real(c, references[i]) == NULL || references[i] == TORQUE) return ERROR;
    if (references[i] == PROPORTIONAL && values[i] < 0) {
      say(c, ERROR, "a negative gain");
      return ERROR;
    }
    *real(c, references[i]) = values[i];
  }
  return OK;
}

static int set_text(Controller* c, const Reference* reference, const char* const* text) {
  if (*reference == NAME && strcmp(*text, "PI") == 0) return OK;
  say(c, ERROR, "no such name");
  return ERROR;
}

#ifndef NO_STATE
static int get_state(Controller* c, void** state) {
  if (*state == NULL) *state = malloc(sizeof(State));
  memcpy(*state, &c->state, sizeof(State));
  return OK;
}
static int set_state(Controller* c, void* state) {
  memcpy(&c->state, state, sizeof(State));
  return OK;
}
static int free_state(void** state) {
  free(*state);
  *state = NULL;
  return OK;
}
static int state_size(size_t* size) {
  *size = sizeof(State);
  return OK;
}
static int copy_state(void* bytes, const void* state, size_t size) {
  if (size != sizeof(State)) return ERROR;
  memcpy(bytes, state, size);
  return OK;
}
static int read_state(const void* bytes, size_t size, void** state) {
  if (size != sizeof(State)) return ERROR;
  *state = malloc(size);
  memcpy(*state, bytes, size);
  return OK;
}
#endif

#if FMI == 2

typedef struct {
  void (*log)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*finished)(void*, int);
  void* environment;
} Callbacks;

PUBLIC void* fmi2Instantiate(const char* name, int type, const char* token, const char* resources, const Callbacks* callbacks,
                             int visible, int logging) {
  (void)name, (void)visible, (void)logging;
  if (type != 1 || strncmp(resources, "file:///", 8) != 0) return NULL;
  Controller* c = instantiate(token, resources);
  if (c != NULL) c->log = callbacks->log, c->environment = callbacks->environment;
  return c;
}
PUBLIC int fmi2SetupExperiment(void* c, int has_tolerance, double tolerance, double start, int has_stop, double stop) {
  (void)has_tolerance, (void)tolerance;
  ((Controller*)c)->state.time = start;
  return has_stop && stop > start ? OK : ERROR;
}
PUBLIC int fmi2EnterInitializationMode(void* c) { return c == NULL ? ERROR : OK; }
PUBLIC int fmi2GetReal(void* c, const Reference* r, size_t n, double* v) { return get(c, r, n, v); }
PUBLIC int fmi2SetReal(void* c, const Reference* r, size_t n, const double* v) { return set(c, r, n, v); }
PUBLIC int fmi2SetInteger(void* c, const Reference* r, size_t n, const int* v) {
  (void)n;
  return *r == FAULT ? (((Controller*)c)->state.fault = *v, OK) : ERROR;
}
PUBLIC int fmi2SetBoolean(void* c, const Reference* r, size_t n, const int* v) {
  (void)n;
  return *r == IS_REVERSED ? (((Controller*)c)->state.is_reversed = *v, OK) : ERROR;
}
PUBLIC int fmi2SetString(void* c, const Reference* r, size_t n, const char* const* v) { return (void)n, set_text(c, r, v); }
PUBLIC int fmi2DoStep(void* c, double time, double length, int no_return) { return step(c, time, length, no_return); }
#ifndef NO_STATE
PUBLIC int fmi2GetFMUstate(void* c, void** s) { return get_state(c, s); }
PUBLIC int fmi2SetFMUstate(void* c, void* s) { return set_state(c, s); }
PUBLIC int fmi2FreeFMUstate(void* c, void** s) { return (void)c, free_state(s); }
PUBLIC int fmi2SerializedFMUstateSize(void* c, void* s, size_t* n) { return (void)c, (void)s, state_size(n); }
PUBLIC int fmi2SerializeFMUstate(void* c, void* s, char* b, size_t n) { return (void)c, copy_state(b, s, n); }
PUBLIC int fmi2DeSerializeFMUstate(void* c, const char* b, size_t n, void** s) { return (void)c, read_state(b, n, s); }
#endif

#else

PUBLIC void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible, bool logging,
                                         bool event_mode, bool early, const uint32_t* intermediate, size_t count,
                                         void* environment, void (*log)(void*, int, const char*, const char*),
                                         void* update) {
  (void)name, (void)visible, (void)logging, (void)intermediate, (void)update;
  if (event_mode || early || count > 0 || resources[strlen(resources) - 1] != '/') return NULL;
  Controller* c = instantiate(token, resources);
  if (c != NULL) c->log = log, c->environment = environment;
  return c;
}
PUBLIC int fmi3EnterInitializationMode(void* c, bool has_tolerance, double tolerance, double start, bool has_stop, double stop) {
  (void)has_tolerance, (void)tolerance;
  ((Controller*)c)->state.time = start;
  return has_stop && stop > start ? OK : ERROR;
}
PUBLIC int fmi3GetFloat64(void* c, const Reference* r, size_t n, double* v, size_t m) { return n == m ? get(c, r, n, v) : ERROR; }
PUBLIC int fmi3SetFloat64(void* c, const Reference* r, size_t n, const double* v, size_t m) {
  return n == m ? set(c, r, n, v) : ERROR;
}
PUBLIC int fmi3SetInt32(void* c, const Reference* r, size_t n, const int32_t* v, size_t m) {
  return n == m && *r == FAULT ? (((Controller*)c)->state.fault = *v, OK) : ERROR;
}
PUBLIC int fmi3SetInt64(void* c, const Reference* r, size_t n, const int64_t* v, size_t m) {
  return (void)c, (void)r, (void)n, (void)v, (void)m, ERROR;
}
PUBLIC int fmi3SetBoolean(void* c, const Reference* r, size_t n, const bool* v, size_t m) {
  return n == m && *r == IS_REVERSED ? (((Controller*)c)->state.is_reversed = *v, OK) : ERROR;
}
PUBLIC int fmi3SetString(void* c, const Reference* r, size_t n, const char* const* v, size_t m) {
  return n == m ? set_text(c, r, v) : ERROR;
}
PUBLIC int fmi3DoStep(void* c, double time, double length, bool no_return, bool* events, bool* ends, bool* early, double* reached) {
  *events = *ends = *early = false;
  *reached = time + length;
  const int status = step(c, time, length, no_return);
  if (status != DISCARD) return status;
  *ends = true;
  *reached = time;
  return OK;
}
#ifndef NO_STATE
PUBLIC int fmi3GetFMUState(void* c, void** s) { return get_state(c, s); }
PUBLIC int fmi3SetFMUState(void* c, void* s) { return set_state(c, s); }
PUBLIC int fmi3FreeFMUState(void* c, void** s) { return (void)c, free_state(s); }
PUBLIC int fmi3SerializedFMUStateSize(void* c, void* s, size_t* n) { return (void)c, (void)s, state_size(n); }
PUBLIC int fmi3SerializeFMUState(void* c, void* s, uint8_t* b, size_t n) { return (void)c, copy_state(b, s, n); }
PUBLIC int fmi3DeserializeFMUState(void* c, const uint8_t* b, size_t n, void** s) { return (void)c, read_state(b, n, s); }
#endif

#endif
