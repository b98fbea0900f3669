// The program samara-report: a bake judged by its body file and its cases.

#include "converter/report/case_parts.hpp"

int main(int argc, char** argv) {
    return samara::run_report(argc, argv, samara::read_cases_for_report);
}
