/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Processes as they are with MPI.
 */

#include "pace.h"
#include "processes.h"
#include "rank_crew.h"
#include "thread_crew.h"

#include <boost/mpi/collectives.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/serialization/string.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <sched.h>

namespace tool {
namespace {

namespace mpi = boost::mpi;

/** Whether mpirun, or a batch system in its place, has started several processes. MPI
 * itself can say so only after a start that takes longer than many a registration, and
 * that fails in some places where there is no need for MPI. */
bool
isOneOfMany()
{
  for (const char* size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const text = std::getenv(size))
      return std::atol(text) > 1;
  return std::getenv("PMIX_RANK") || std::getenv("PMI_RANK");
}

/** The cores that this rank may use, divided among those that may use the same. */
unsigned int
shareOfCores(const mpi::communicator& ranks)
{
  MPI_Comm same_machine = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &same_machine);
  const mpi::communicator neighbours(same_machine, mpi::comm_take_ownership);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  std::string mine(sizeof cores, '\0');
  int number = static_cast<int>(std::thread::hardware_concurrency());
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) {
    number = CPU_COUNT(&cores);
    std::memcpy(mine.data(), &cores, sizeof cores);
  }
  std::vector<std::string> all;
  mpi::all_gather(neighbours, mine, all);
  const auto sharing = static_cast<int>(std::count(all.begin(), all.end(), mine));
  return static_cast<unsigned int>(std::max(1, number / sharing));
}

} // namespace

class Processes::Ranks {
public:
  Ranks()
  : environment_(mpi::threading::funneled, false) // exceptions end it in an orderly way
  {
    if (environment_.thread_level() < mpi::threading::funneled)
      throw std::runtime_error("this MPI does not allow for threads; start without "
                               "mpirun");
    cores_ = shareOfCores(world_);
  }

  /** MPI's own end waits for all ranks, those that are gone too, and for ever. */
  ~Ranks()
  {
    std::cout.flush();
    std::thread([] {
      std::this_thread::sleep_for(Patience::ofEnvironment().with_worker);
      std::_Exit(EXIT_FAILURE);
    }).detach();
  }

  Ranks(const Ranks&) = delete;
  Ranks&
  operator=(const Ranks&) = delete;

  const mpi::communicator&
  world() const
  {
    return world_;
  }

  unsigned int
  threads(unsigned int wanted) const
  {
    return wanted > 0 ? wanted : cores_;
  }

private:
  mpi::environment environment_;
  mpi::communicator world_;
  unsigned int cores_ = 1;
};

Processes::Processes()
{
  if (isOneOfMany())
    ranks_ = std::make_unique<Ranks>();
}

Processes::~Processes() = default;

bool
Processes::leads() const
{
  return !ranks_ || ranks_->world().rank() == 0;
}

std::size_t
Processes::number() const
{
  return ranks_ ? static_cast<std::size_t>(ranks_->world().size()) : 1;
}

std::unique_ptr<Crew>
Processes::crew(JobHandler handler, unsigned int threads) const
{
  if (number() == 1)
    return std::make_unique<ThreadCrew>(std::move(handler), threads);
  return std::make_unique<RankCrew>(ranks_->world(), std::move(handler),
                                    ranks_->threads(threads));
}

void
Processes::serve(JobHandler handler, unsigned int threads) const
{
  serveRankCrew(ranks_->world(), std::move(handler), ranks_->threads(threads));
}

} // namespace tool
