/*
 * Times each answer of an engine. When the process ends, it says on the standard error, in one line of JSON, how many
 * answers there were and how long the engine took for them. Only the call of the engine is timed, not the making of its
 * shapes.
 */
#ifndef PEERS_TIMED_H
#define PEERS_TIMED_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <time.h>

/* Answers by their time: four classes to each power of two of a nanosecond. */
#define PEERS_CLASSES 160

static struct {
    uint64_t calls, nanoseconds, worst, classes[PEERS_CLASSES];
} peers_times;

static uint64_t peers_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static void peers_took(uint64_t start) {
    uint64_t time = peers_now() - start;
    int class_of = (int)(4 * log2((double)(time ? time : 1)));
    peers_times.calls += 1;
    peers_times.nanoseconds += time;
    if (time > peers_times.worst) peers_times.worst = time;
    peers_times.classes[class_of < PEERS_CLASSES ? class_of : PEERS_CLASSES - 1] += 1;
}

/* The time that this share of the answers did not exceed, up to a fifth. */
static double peers_quantile(double share) {
    uint64_t sum = 0;
    int i = 0;
    for (; i < PEERS_CLASSES - 1; i++) {
        sum += peers_times.classes[i];
        if ((double)sum >= share * (double)peers_times.calls) break;
    }
    return exp2((i + 0.5) / 4);
}

__attribute__((destructor)) static void peers_report(void) {
    if (peers_times.calls == 0) return;
    fprintf(stderr, "{\"calls\": %llu, \"mean_ns\": %.1f, \"median_ns\": %.0f, \"p99_ns\": %.0f, \"worst_ns\": %llu}\n",
            (unsigned long long)peers_times.calls, (double)peers_times.nanoseconds / (double)peers_times.calls,
            peers_quantile(0.5), peers_quantile(0.99), (unsigned long long)peers_times.worst);
}

#endif
